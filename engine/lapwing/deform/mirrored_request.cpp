#include "lapwing/deform/mirrored_request.h"

#include <algorithm>
#include <cmath>
#include <sstream>

namespace lapwing {
namespace {

using Eigen::Affine3d;
using Eigen::Matrix3d;
using Eigen::Vector3d;

// From here on people would call a shape not symmetric.
constexpr double kLargeAsymmetry = 0.02;

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

  DeformRequest both_sides() const {
    DeformRequest both = request_;
    both.mirror.reset();
    both.roi = with_image(request_.roi);
    if (const auto* belt = std::get_if<RegionSpec>(&request_.belt)) both.belt = with_image(*belt);
    add_handles(both);
    add_targets(both);
    return both;
  }

 private:
  RegionSpec with_image(const RegionSpec& spec) const {
    const VertexSet set = resolve(spec, mesh_);
    return listed(unite(set, mirrored(set, images_)), spec);
  }

  std::vector<double> mirrored_field(const std::vector<double>& field) const {
    if (field.size() != images_.size()) return field;  // which is an error elsewhere, or none
    std::vector<double> mirrored;
    for (const Index image : images_) mirrored.push_back(field[image]);
    return mirrored;
  }

  Grading with_image(Grading grading) const {
    const std::vector<double> mirrored = mirrored_field(grading.field);
    for (std::size_t v = 0; v < mirrored.size(); ++v) {
      grading.field[v] = std::max(grading.field[v], mirrored[v]);
    }
    return grading;
  }

  void add_handles(DeformRequest& both) const {
    std::vector<MovedHandle> images;
    for (MovedHandle& handle : both.handles) {
      VertexSet set = resolve(handle.region, mesh_);
      VertexSet image = mirrored(set, images_);
      if (!intersect(set, image).empty()) {
        handle = {listed(unite(set, image), handle.region), along_mirror(handle.move, plane_),
                  with_image(handle.grading)};
        continue;
      }
      RegionSpec region = listed(std::move(image), handle.region);
      region.where += " (its image)";
      images.push_back({std::move(region), mirror_image(handle.move, plane_),
                        {handle.grading.weight, handle.grading.falloff,
                         mirrored_field(handle.grading.field)}});
    }
    both.handles.insert(both.handles.end(), images.begin(), images.end());
  }

  void add_targets(DeformRequest& both) const {
    const Affine3d mirror = reflection(plane_);
    std::vector<TargetRow> images;
    for (TargetRow& row : both.targets.rows) {
      TargetRow image = row;
      image.position = mirror * row.position;
      if (const auto* point = std::get_if<Vector3d>(&row.point)) {
        image.point = Vector3d(mirror * *point);
      } else {
        const Index v = std::get<Index>(row.point);
        if (v >= images_.size()) continue;  // which is an error elsewhere
        if (images_[v] == v) {
          row.position = onto(plane_, row.position);
          continue;
        }
        image.point = images_[v];
      }
      images.push_back(std::move(image));
    }
    both.targets.rows.insert(both.targets.rows.end(), images.begin(), images.end());
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
    text << "mirrored in the plane through " << in_words(found.plane.point) << " across "
         << in_words(found.plane.normal.normalized()) << ", found from the shape";
  } else {
    text << "mirrored";
  }
  text << "; the mesh is off from its image by " << 100.0 * found.asymmetry
       << "% of its diagonal (root mean square)";
  if (found.asymmetry > kLargeAsymmetry) {
    text << ", which is much: is this its plane of symmetry?";
  }
  return text.str();
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
  if (along.pivot) along.pivot = onto(plane, *along.pivot);
  return along;
}

MirroredRequest mirrored_request(const DeformRequest& request, const Mesh& mesh) {
  if (!request.mirror) return {request, {}};
  const MirrorSpec& spec = *request.mirror;
  const bool automatic = std::holds_alternative<AutomaticMirror>(spec.plane);
  FoundMirror found;
  if (automatic) {
    found = find_mirror_plane(mesh, spec.where);
  } else {
    found.plane = std::get<MirrorPlane>(spec.plane);
  }
  MirroredRequest result{Mirroring(request, mesh, found.plane).both_sides(), {}};
  if (!automatic) found.asymmetry = asymmetry_of(mesh, found.plane, spec.where);
  result.notes.push_back(in_words(found, automatic));
  return result;
}

}  // namespace lapwing
