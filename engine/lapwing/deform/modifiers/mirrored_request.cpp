#include "lapwing/deform/modifiers/mirrored_request.h"

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <sstream>

#include "lapwing/base/errors.h"
#include "lapwing/mesh/topology.h"

namespace lapwing {
namespace {

using Eigen::Affine3d;
using Eigen::Matrix3d;
using Eigen::Vector3d;

// Fraction of the diagonal. If the asymmetry is larger, a note asks the user to check the plane.
constexpr double kLargeAsymmetry = 0.02;
// Fraction of the diagonal. Points closer to the plane count as points of the plane, and a mesh
// closer to its image counts as symmetric.
constexpr double kRounding = 1e-9;

Matrix3d mirror_matrix(const MirrorPlane& plane) {
  return reflection(plane).linear();
}

Vector3d onto(const MirrorPlane& plane, const Vector3d& point) {
  return 0.5 * (point + reflection(plane) * point);
}

RegionSpec listed(VertexSet vertices, const RegionSpec& of) {
  return {ListedVertices{std::move(vertices)}, of.where};
}

class Mirroring {
 public:
  Mirroring(const DeformRequest& request, const Mesh& mesh, const MirrorPlane& plane)
      : request_(request),
        mesh_(mesh),
        plane_(plane),
        images_(mirror_images(mesh, plane, request.mirror->where)) {}

  MirroredRequest both_sides() const {
    MirroredRequest result{request_, {}, plane_, {}};
    DeformRequest& both = result.request;
    both.mirror.reset();
    both.roi = with_image(request_.roi);
    if (const auto* belt = std::get_if<RegionSpec>(&request_.belt)) both.belt = with_image(*belt);
    result.handle_images = add_handles(both);
    add_targets(both);
    for (StiffnessSpec& spec : both.stiffness) spec = with_image(std::move(spec));
    make_regions_symmetric(both, result.handle_images);
    return result;
  }

 private:
  RegionSpec with_image(const RegionSpec& spec) const {
    const VertexSet set = resolve(spec, mesh_);
    return listed(unite(set, mirrored(set, images_)), spec);
  }

  // Copies painted factors to the mirror images of their vertices. If both a vertex and its image
  // are painted, both get the larger factor.
  StiffnessSpec with_image(StiffnessSpec spec) const {
    const std::vector<char> painted = vertex_mask(images_.size(), resolve(spec.region, mesh_));
    const std::vector<double> field = spec.field;
    // A wrong size is reported elsewhere.
    for (std::size_t v = 0; v < field.size() && field.size() == images_.size(); ++v) {
      const Index image = images_[v];
      if (painted[image] == 0) continue;
      spec.field[v] = painted[v] == 0 ? field[image] : std::max(field[v], field[image]);
    }
    spec.region = with_image(spec.region);
    return spec;
  }

  std::vector<double> mirrored_field(const std::vector<double>& field) const {
    // An empty field stays empty. A wrong size is reported elsewhere.
    if (field.size() != images_.size()) return field;
    std::vector<double> mirrored;
    for (const Index image : images_) mirrored.push_back(field[image]);
    return mirrored;
  }

  Falloff with_image(Falloff falloff) const {
    const std::vector<double> mirrored = mirrored_field(falloff.field);
    for (std::size_t v = 0; v < mirrored.size(); ++v) {
      falloff.field[v] = std::max(falloff.field[v], mirrored[v]);
    }
    return falloff;
  }

  // Returns the vertices with the full weight of a handle.
  VertexSet full(const VertexSet& set, const Falloff& falloff) const {
    if (falloff.field.size() != images_.size()) return set;
    VertexSet full;
    std::copy_if(set.begin(), set.end(), std::back_inserter(full),
                 [&](Index v) { return falloff.field[v] == 1.0; });
    return full;
  }

  // Adds the images of the handles. Returns the index of the image for each handle, including the
  // added handles.
  std::vector<std::size_t> add_handles(DeformRequest& both) const {
    std::vector<MovedHandle> images;
    std::vector<std::size_t> numbers(both.handles.size());
    std::vector<VertexSet> held;
    for (const MovedHandle& handle : both.handles) {
      held.push_back(full(resolve(handle.region, mesh_), handle.falloff));
    }
    for (std::size_t h = 0; h < both.handles.size(); ++h) {
      MovedHandle& handle = both.handles[h];
      const VertexSet set = resolve(handle.region, mesh_);
      VertexSet image = mirrored(set, images_);
      const VertexSet held_image = mirrored(held[h], images_);
      require_other_place(both.handles, held, h, held_image);
      if (!intersect(held[h], held_image).empty()) {
        handle = {listed(unite(set, image), handle.region), along_mirror(handle.move, plane_),
                  with_image(handle.falloff), handle.orientation,
                  mapped(handle.path, [&](const Move& m) { return along_mirror(m, plane_); })};
        numbers[h] = h;
        continue;
      }
      numbers[h] = both.handles.size() + images.size();
      numbers.push_back(h);
      RegionSpec region = listed(std::move(image), handle.region);
      region.where += " (mirror image)";
      images.push_back(
          {std::move(region),
           mirror_image(handle.move, plane_),
           {handle.falloff.weight, handle.falloff.transition, mirrored_field(handle.falloff.field)},
           handle.orientation,
           mapped(handle.path, [&](const Move& m) { return mirror_image(m, plane_); })});
    }
    both.handles.insert(both.handles.end(), images.begin(), images.end());
    return numbers;
  }

  static std::vector<Move> mapped(const std::vector<Move>& path, const auto& map) {
    std::vector<Move> moves;
    std::ranges::transform(path, std::back_inserter(moves), map);
    return moves;
  }

  static void require_other_place(const std::vector<MovedHandle>& handles,
                                  const std::vector<VertexSet>& held, std::size_t h,
                                  const VertexSet& image) {
    for (std::size_t k = 0; k < held.size(); ++k) {
      if (k == h) continue;
      const VertexSet shared = intersect(held[k], image);
      if (shared.empty()) continue;
      throw InputError(handles[h].region.where + ": its mirror image contains vertex " +
                           std::to_string(shared.front()) + " of handle " + std::to_string(k) +
                           "; give the handles of one side only, or remove \"mirror\"",
                       shared);
    }
  }

  bool is_lone(Index v) const { return mesh_.topology().rings.size(v) == 0; }

  void add_targets(DeformRequest& both) const {
    const Affine3d mirror = reflection(plane_);
    const double in_plane = kRounding * bounds_of(mesh_.positions).diagonal();
    std::vector<TargetRow> images;
    for (std::size_t r = 0; r < both.targets.rows.size(); ++r) {
      TargetRow& row = both.targets.rows[r];
      const auto* vertex = std::get_if<Index>(&row.point);
      // A wrong index is reported elsewhere; vertices without a triangle have no image.
      if (vertex != nullptr && (*vertex >= images_.size() || is_lone(*vertex))) continue;
      const Vector3d point =
          vertex != nullptr ? mesh_.positions[*vertex] : std::get<Vector3d>(row.point);
      const Vector3d image = mirror * point;
      if (vertex != nullptr ? images_[*vertex] == *vertex : (image - point).norm() <= in_plane) {
        row.position = onto(plane_, row.position);
        continue;
      }
      images.push_back({image, mirror * row.position, row.weight, r});
    }
    both.targets.rows.insert(both.targets.rows.end(), images.begin(), images.end());
  }

  // Replaces a belt given as a fraction, falloffs and fields by symmetric lists and fields.
  // Geodesic distances are not exactly symmetric: if several paths have the same length, they
  // depend on the order of the vertices.
  void make_regions_symmetric(DeformRequest& both,
                              const std::vector<std::size_t>& handle_images) const {
    const EditRegion region = resolve_edit_region(both, mesh_);
    if (const auto* belt = std::get_if<BoundaryAnchors>(&both.belt)) {
      VertexSet listed = unite(region.belt, intersect(region.roi, mirrored(region.belt, images_)));
      for (const VertexSet& handle : region.handles) listed = subtract(listed, handle);
      listed = subtract(listed, corners_of(region.targets));
      both.belt = RegionSpec{ListedVertices{std::move(listed)}, belt->where};
    }
    const std::vector<FalloffVertex> graded = symmetric(region.graded, handle_images);
    for (std::size_t h = 0; h < both.handles.size(); ++h) {
      MovedHandle& handle = both.handles[h];
      VertexSet set = region.handles[h];
      std::vector<double> field(mesh_.vertex_count(), 0.0);
      for (const Index v : set) field[v] = 1.0;
      for (const FalloffVertex& g : graded) {
        if (g.handle != h) continue;
        set.push_back(g.vertex);
        field[g.vertex] = g.weight;
      }
      if (set.size() == region.handles[h].size()) field.clear();
      handle.region = listed(make_vertex_set(std::move(set)), handle.region);
      handle.falloff = {handle.falloff.weight, {}, std::move(field)};
    }
  }

  // Returns the entries for which a vertex and its image have corresponding handles, with the mean
  // of both weights. A vertex that is its own image can only follow handles that are their own
  // images.
  std::vector<FalloffVertex> symmetric(const std::vector<FalloffVertex>& graded,
                                       const std::vector<std::size_t>& handle_images) const {
    std::vector<const FalloffVertex*> of_vertex(images_.size(), nullptr);
    for (const FalloffVertex& g : graded) of_vertex[g.vertex] = &g;
    std::vector<FalloffVertex> agreed;
    for (const FalloffVertex& g : graded) {
      const Index image = images_[g.vertex];
      if (images_[image] != g.vertex) {
        agreed.push_back(g);  // The mesh is not exactly symmetric, and the vertex has no partner.
        continue;
      }
      const FalloffVertex* other = of_vertex[image];
      if (other == nullptr || other->handle != handle_images[g.handle]) continue;
      agreed.push_back({g.vertex, g.handle, 0.5 * (g.weight + other->weight)});
    }
    return agreed;
  }

  const DeformRequest& request_;
  const Mesh& mesh_;
  const MirrorPlane& plane_;
  std::vector<Index> images_;
};

std::string in_words(const Vector3d& v) {
  std::ostringstream text;
  text << "(" << v.x() << ", " << v.y() << ", " << v.z() << ")";
  return text.str();
}

std::string in_words(const FoundMirror& found, bool automatic) {
  std::ostringstream text;
  if (automatic) {
    text << "mirrored in the plane through " << in_words(found.plane.point) << " with normal "
         << in_words(found.plane.normal.normalized()) << ", found from the shape";
  } else {
    text << "mirrored";
  }
  if (found.asymmetry < kRounding) {
    text << "; the mesh is symmetric";
    return text.str();
  }
  text << "; the mesh differs from its image by " << std::setprecision(3) << 100.0 * found.asymmetry
       << "% of its diagonal (root mean square)";
  if (found.asymmetry > kLargeAsymmetry) {
    text << ". That is large: make sure that this is its plane of symmetry";
  }
  return text.str();
}

}  // namespace

namespace {

// Returns the mirror image of scale factors along the coordinate axes. Throws InputError if the
// image does not scale along these axes, as for most planes.
Vector3d mirrored_scale(const Vector3d& scale, const MirrorPlane& plane) {
  const Matrix3d F = mirror_matrix(plane);
  const Matrix3d image = F * scale.asDiagonal() * F;
  constexpr double kAlongAxes = 1e-6;
  const Matrix3d off_axes = image - Matrix3d(image.diagonal().asDiagonal());
  if (scale.maxCoeff() == scale.minCoeff()) return scale;
  if (off_axes.norm() > kAlongAxes * image.norm()) {
    throw InputError(
        "a move with a different scale for each axis can only be mirrored across a plane "
        "perpendicular to an axis; scale all axes equally, or give the move as a \"matrix\"");
  }
  return image.diagonal();
}

}  // namespace

Move mirror_image(const Move& move, const MirrorPlane& plane) {
  const Affine3d mirror = reflection(plane);
  if (const auto* matrix = std::get_if<MatrixMove>(&move)) {
    Affine3d map = Affine3d::Identity();
    map.affine() = matrix->matrix;
    return MatrixMove{(mirror * map * mirror).affine()};
  }
  SimilarityMove image = std::get<SimilarityMove>(move);
  image.translate = mirror.linear() * image.translate;
  image.rotate = {mirror.linear() * image.rotate.axis, -image.rotate.degrees};
  image.scale = mirrored_scale(image.scale, plane);
  if (image.pivot) image.pivot = mirror * *image.pivot;
  return image;
}

Move along_mirror(const Move& move, const MirrorPlane& plane) {
  if (const auto* matrix = std::get_if<MatrixMove>(&move)) {
    const auto image = std::get<MatrixMove>(mirror_image(move, plane));
    return MatrixMove{0.5 * (matrix->matrix + image.matrix)};
  }
  SimilarityMove along = std::get<SimilarityMove>(move);
  const Vector3d normal = plane.normal.normalized();
  along.translate = 0.5 * (along.translate + mirror_matrix(plane) * along.translate);
  along.rotate = {normal, along.rotate.degrees * along.rotate.axis.normalized().dot(normal)};
  along.scale = 0.5 * (along.scale + mirrored_scale(along.scale, plane));
  if (along.pivot) along.pivot = onto(plane, *along.pivot);
  return along;
}

MirroredRequest mirrored_request(const DeformRequest& request, const Mesh& mesh) {
  if (!request.mirror) return {request, {}, {}, {}};
  const MirrorSpec& spec = *request.mirror;
  const bool automatic = std::holds_alternative<AutomaticMirror>(spec.plane);
  FoundMirror found;
  if (automatic) {
    found = find_mirror_plane(mesh, spec.where);
  } else {
    found.plane = std::get<MirrorPlane>(spec.plane);
  }
  MirroredRequest result = Mirroring(request, mesh, found.plane).both_sides();
  if (!automatic) found.asymmetry = asymmetry_of(mesh, found.plane, spec.where);
  result.notes.push_back(in_words(found, automatic));
  return result;
}

}  // namespace lapwing
