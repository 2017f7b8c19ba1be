#include "lapwing/remesh/transfer_to_mesh.h"

#include <algorithm>
#include <array>
#include <utility>

#include <Eigen/Geometry>

#include "lapwing/base/cancellation.h"
#include "lapwing/base/parallel.h"
#include "lapwing/mesh/compact.h"

namespace lapwing::remeshing {
namespace {

using Eigen::Vector3d;

constexpr std::size_t kGrain = 256;

// The points of the original mesh that correspond to the vertices, corners and triangles of the
// patch. Feature lines divide the corners around a vertex into sectors. The corners of a sector
// have the same attributes.
struct AttributeSources {
  std::vector<SurfacePoint> vertices;     //< per vertex, by mesh vertices; nowhere() if removed
  std::vector<Index> sectors_of_corners;  //< per half-edge: the sector of the corner at its origin
  std::vector<SurfacePoint> sectors;      //< per sector, by mesh corners
  std::vector<Index> faces;               //< per triangle, a face of the mesh; kNoIndex if removed
};

// Expresses each vertex by weights of mesh vertices, and each sector by weights of mesh corners.
class SourceFinder {
 public:
  explicit SourceFinder(const WorkingPatch& patch)
      : patch_(patch), net_(patch.net), original_(patch.original) {}

  AttributeSources run() {
    sources_.vertices.resize(net_.vertex_count());
    sources_.sectors_of_corners.assign(net_.halfedge_count(), kNoIndex);
    find_free_points();
    CancelCheck cancel_check;
    for (Index v = 0; v < net_.vertex_count(); ++v) {
      cancel_check();
      if (!net_.has_vertex(v)) continue;
      if (patch_.kinds[v] == VertexKind::free) add_free(v);
      if (patch_.kinds[v] == VertexKind::line) add_on_line(v);
      if (patch_.kinds[v] == VertexKind::fixed) add_fixed(v);
    }
    find_faces();
    return std::move(sources_);
  }

 private:
  void find_free_points() {
    free_points_.resize(net_.vertex_count());
    parallel_for(free_points_.size(), kGrain, [&](std::size_t begin, std::size_t end) {
      CancelCheck cancel_check;
      for (auto v = static_cast<Index>(begin); v < end; ++v) {
        cancel_check();
        if (!net_.has_vertex(v) || patch_.kinds[v] != VertexKind::free) continue;
        free_points_[v] = patch_.reference.on_sheet(patch_.sheet_of[net_.outgoing(v) / 3],
                                                    patch_.at(v), patch_.normal_at(v));
      }
    });
  }

  void find_faces() {
    sources_.faces.assign(net_.triangle_count(), kNoIndex);
    parallel_for(sources_.faces.size(), kGrain, [&](std::size_t begin, std::size_t end) {
      CancelCheck cancel_check;
      for (auto t = static_cast<Index>(begin); t < end; ++t) {
        cancel_check();
        if (!net_.is_alive(3 * t)) continue;
        const auto [a, b, c] = patch_.triangle(3 * t);
        const TrianglePoint found =
            patch_.reference.on_sheet(patch_.sheet_of[t], (a + b + c) / 3.0, (b - a).cross(c - a));
        sources_.faces[t] = original_.faces[found.triangle];
      }
    });
  }

  Index mesh_corner(Index original_halfedge) const {
    return original_.corners[original_halfedge / 3][original_halfedge % 3];
  }
  Index mesh_vertex(Index original_halfedge) const {
    return original_.mesh_vertices[original_.net.origin(original_halfedge)];
  }

  // Adds the sector that starts at `first` and ends, counterclockwise, at the next line or border,
  // or contains all corners.
  void add_sector(Index first, const SurfacePoint& in_corners) {
    Index h = first;
    do {
      sources_.sectors_of_corners[h] = static_cast<Index>(sources_.sectors.size());
      h = net_.turn(h);
    } while (h != kNoIndex && h != first && !net_.on_line(h));
    sources_.sectors.push_back(in_corners);
  }

  void add_free(Index v) {
    const TrianglePoint& found = free_points_[v];
    const Index h = 3 * found.triangle;
    sources_.vertices[v] = {{mesh_vertex(h), mesh_vertex(h + 1), mesh_vertex(h + 2)},
                            found.weights};
    add_sector(net_.outgoing(v), {original_.corners[found.triangle], found.weights});
  }

  void add_on_line(Index v) {
    const LinePoint found = patch_.reference.on_line(patch_.line_of(v), patch_.at(v));
    const std::array weights{1.0 - found.along, found.along, 0.0};
    const Index from = found.halfedge;
    const Index to = Halfedges::next(from);
    sources_.vertices[v] = {{mesh_vertex(from), mesh_vertex(to), mesh_vertex(to)}, weights};
    const Index other_to = original_.net.twin(from);
    const Index other_from = Halfedges::next(other_to);
    net_.for_outgoing(v, [&](Index h) {
      if (!net_.on_line(h)) return;
      const bool same_way = net_.side(h) % 2 == 0;
      const Index a = mesh_corner(same_way ? from : other_from);
      const Index b = mesh_corner(same_way ? to : other_to);
      add_sector(h, {{a, b, b}, weights});
    });
  }

  // Fixed vertices are vertices of the original mesh. Lines and borders at them have the same sides
  // as in the original.
  void add_fixed(Index v) {
    sources_.vertices[v] = SurfacePoint::at_vertex(original_.mesh_vertices[v]);
    bool has_lines = false;
    net_.for_outgoing(v, [&](Index h) {
      if (!net_.on_line(h)) return;
      has_lines = true;
      add_sector(h, SurfacePoint::at_vertex(original_corner(v, net_.side(h))));
    });
    if (has_lines) return;
    add_sector(net_.outgoing(v), SurfacePoint::at_vertex(mesh_corner(original_.net.outgoing(v))));
  }

  Index original_corner(Index v, Index side) const {
    Index corner = kNoIndex;
    original_.net.for_outgoing(v, [&](Index h) {
      if (original_.net.side(h) == side) corner = mesh_corner(h);
    });
    return corner;
  }

  const WorkingPatch& patch_;
  const Halfedges& net_;
  const OriginalPatch& original_;
  std::vector<TrianglePoint> free_points_;
  AttributeSources sources_;
};

Index nearest_corner(const SurfacePoint& point) {
  const auto largest = std::max_element(point.weights.begin(), point.weights.end());
  return point.corners[static_cast<std::size_t>(largest - point.weights.begin())];
}

class Carrier {
 public:
  Carrier(const Mesh& mesh, const WorkingPatch& patch)
      : mesh_(mesh),
        patch_(patch),
        net_(patch.net),
        original_(patch.original),
        sources_(SourceFinder(patch).run()) {
    result_.mesh = mesh;
  }

  RemeshResult run() {
    number_vertices();
    carry_faces();
    carry_vertices();
    carry_corners();
    result_.region = make_vertex_set(std::move(result_.region));
    return std::move(result_);
  }

 private:
  // Numbers first the remaining mesh vertices, then the new vertices of the patch.
  void number_vertices() {
    std::vector<char> stays(mesh_.vertex_count(), 1);
    for (Index v = 0; v < original_.mesh_vertices.size(); ++v) {
      if (!original_.bound[v]) stays[original_.mesh_vertices[v]] = 0;
    }
    new_numbers_.assign(mesh_.vertex_count(), kNoIndex);
    for (Index v = 0; v < mesh_.vertex_count(); ++v) {
      if (!stays[v]) continue;
      new_numbers_[v] = static_cast<Index>(vertex_sources_.size());
      vertex_sources_.push_back(v);
    }
    result_.kept = vertex_sources_;
    numbers_.assign(net_.vertex_count(), kNoIndex);
    CancelCheck cancel_check;
    for (Index v = 0; v < net_.vertex_count(); ++v) {
      cancel_check();
      if (!net_.has_vertex(v)) continue;
      if (is_bound(v)) {
        numbers_[v] = new_numbers_[original_.mesh_vertices[v]];
      } else {
        numbers_[v] = static_cast<Index>(vertex_sources_.size());
        vertex_sources_.push_back(nearest_corner(sources_.vertices[v]));
        result_.kept.push_back(kNoIndex);
      }
      result_.region.push_back(numbers_[v]);
    }
  }

  bool is_bound(Index v) const { return v < original_.bound.size() && original_.bound[v]; }

  void carry_faces() {
    FaceSources faces;
    CancelCheck cancel_check;
    for (Index f = 0; f < mesh_.face_count(); ++f) {
      cancel_check();
      if (!original_.faces_outside[f]) continue;
      faces.faces.push_back(f);
      for (Index c = mesh_.face_starts()[f]; c < mesh_.face_starts()[f + 1]; ++c) {
        faces.corners.push_back(c);
      }
      faces.starts.push_back(static_cast<Index>(faces.corners.size()));
    }
    first_corner_ = faces.corners.size();
    for (Index h = 0; h < net_.halfedge_count(); ++h) {
      cancel_check();
      if (!net_.is_alive(h)) continue;
      if (h % 3 == 0) faces.faces.push_back(sources_.faces[h / 3]);
      faces.corners.push_back(nearest_corner(sources_.sectors[sources_.sectors_of_corners[h]]));
      corner_halfedges_.push_back(h);
      if (h % 3 == 2) faces.starts.push_back(static_cast<Index>(faces.corners.size()));
    }
    replace_faces(result_.mesh, faces);
    std::vector<Index>& vertices = result_.mesh.edit_faces().vertices;
    for (std::size_t c = 0; c < first_corner_; ++c) vertices[c] = new_numbers_[vertices[c]];
    for (std::size_t i = 0; i < corner_halfedges_.size(); ++i) {
      vertices[first_corner_ + i] = numbers_[net_.origin(corner_halfedges_[i])];
    }
  }

  void carry_vertices() {
    replace_vertices(result_.mesh, vertex_sources_);
    MeshAttributes& a = result_.mesh.edit_attributes();
    const MeshAttributes& old = mesh_.attributes();
    CancelCheck cancel_check;
    for (Index v = 0; v < net_.vertex_count(); ++v) {
      cancel_check();
      if (!net_.has_vertex(v) || is_bound(v)) continue;
      const Index n = numbers_[v];
      const SurfacePoint& source = sources_.vertices[v];
      result_.mesh.positions[n] = patch_.at(v);
      if (!a.vertex_colors.empty()) a.vertex_colors[n] = color(source);
      if (a.has_vertex_normals) a.normals[n] = blend_normals(source, old.normals);
      for (std::size_t e = 0; e < a.vertex_extras.size(); ++e) {
        blend_extra(source, old.vertex_extras[e], n, a.vertex_extras[e]);
      }
    }
  }

  Eigen::Vector4f color(const SurfacePoint& source) const {
    Eigen::Vector4d sum = Eigen::Vector4d::Zero();
    for (std::size_t k = 0; k < 3; ++k) {
      const Eigen::Vector4f& corner = mesh_.attributes().vertex_colors[source.corners[k]];
      sum += source.weights[k] * corner.cast<double>();
    }
    return sum.cast<float>();
  }

  // Returns the interpolated unit normal or, if the normals cancel, the normal of the nearest
  // corner.
  static Eigen::Vector3d blend_normals(const SurfacePoint& source,
                                       const std::vector<Eigen::Vector3d>& normals) {
    const Eigen::Vector3d sum = source.of<Eigen::Vector3d>(normals);
    const double length = sum.norm();
    return length > 1e-6 ? Eigen::Vector3d(sum / length) : normals[nearest_corner(source)];
  }

  // Interpolates real attributes. Integers (flags, labels) keep the value of the nearest vertex,
  // which replace_vertices copied.
  static void blend_extra(const SurfacePoint& source, const ExtraAttribute& old, Index n,
                          ExtraAttribute& extra) {
    const bool is_real = extra.type.find("float") != std::string::npos ||
                         extra.type.find("double") != std::string::npos;
    if (!is_real || extra.values.empty()) return;
    const auto components = static_cast<std::size_t>(extra.components);
    for (std::size_t c = 0; c < components; ++c) {
      double sum = 0.0;
      for (std::size_t k = 0; k < 3; ++k) {
        sum += source.weights[k] * old.values[source.corners[k] * components + c];
      }
      extra.values[n * components + c] = sum;
    }
  }

  void carry_corners() {
    MeshAttributes& a = result_.mesh.edit_attributes();
    if (!a.corner_uvs.empty()) {
      carry_list(mesh_.attributes().corner_uvs, a.uvs, a.corner_uvs,
                 [](const SurfacePoint& source, const std::vector<Eigen::Vector2d>& uvs) {
                   return source.of<Eigen::Vector2d>(uvs);
                 });
    }
    if (!a.corner_normals.empty()) {
      carry_list(mesh_.attributes().corner_normals, a.normals, a.corner_normals, blend_normals);
    }
  }

  // All new corners of a sector get one interpolated value. Corners at an original corner, and
  // corners for which an original corner has no value, keep the value of the nearest corner, which
  // replace_faces copied.
  template <class Value, class Blend>
  void carry_list(const std::vector<Index>& old_of_corner, std::vector<Value>& values,
                  std::vector<Index>& of_corner, const Blend& blend) {
    std::vector<Index> of_sector(sources_.sectors.size(), kNoIndex);
    CancelCheck cancel_check;
    for (std::size_t i = 0; i < corner_halfedges_.size(); ++i) {
      cancel_check();
      const Index sector = sources_.sectors_of_corners[corner_halfedges_[i]];
      SurfacePoint source = sources_.sectors[sector];
      if (std::ranges::find(source.weights, 1.0) != source.weights.end()) continue;
      for (Index& corner : source.corners) corner = old_of_corner[corner];
      if (std::ranges::find(source.corners, kNoIndex) != source.corners.end()) continue;
      if (of_sector[sector] == kNoIndex) {
        of_sector[sector] = static_cast<Index>(values.size());
        values.push_back(blend(source, values));
      }
      of_corner[first_corner_ + i] = of_sector[sector];
    }
    drop_unused(old_of_corner, values, of_corner);
  }

  // Removes the values that only corners of the old patch used.
  template <class Value>
  static void drop_unused(const std::vector<Index>& old_of_corner, std::vector<Value>& values,
                          std::vector<Index>& of_corner) {
    std::vector<char> is_dropped(values.size(), 0);
    for (const Index i : old_of_corner) {
      if (i != kNoIndex) is_dropped[i] = 1;
    }
    for (const Index i : of_corner) {
      if (i != kNoIndex) is_dropped[i] = 0;
    }
    std::vector<Index> numbers(values.size(), kNoIndex);
    std::size_t left = 0;
    for (std::size_t i = 0; i < values.size(); ++i) {
      if (is_dropped[i]) continue;
      values[left] = values[i];
      numbers[i] = static_cast<Index>(left++);
    }
    values.resize(left);
    for (Index& i : of_corner) {
      if (i != kNoIndex) i = numbers[i];
    }
  }

  const Mesh& mesh_;
  const WorkingPatch& patch_;
  const Halfedges& net_;
  const OriginalPatch& original_;
  AttributeSources sources_;
  RemeshResult result_;
  std::vector<Index> new_numbers_;       // per mesh vertex
  std::vector<Index> numbers_;           // per vertex of the patch
  std::vector<Index> vertex_sources_;    // per vertex of the result: the mesh vertex it copies
  std::vector<Index> corner_halfedges_;  // per new corner
  std::size_t first_corner_ = 0;         // first corner of the patch in the result
};

}  // namespace

RemeshResult transfer_to_mesh(const Mesh& mesh, const WorkingPatch& patch) {
  return Carrier(mesh, patch).run();
}

}  // namespace lapwing::remeshing
