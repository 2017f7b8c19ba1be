#include "lapwing/parameterize/parameterize.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include <Eigen/Geometry>

#include "lapwing/base/cancellation.h"
#include "lapwing/base/errors.h"
#include "lapwing/mesh/compact.h"

namespace lapwing {
namespace {

using Eigen::Matrix2d;
using Eigen::Vector2d;
using Eigen::Vector3d;

struct Measures {
  double surface_area = 0.0;
  double plane_area = 0.0;
  double squared_stretch = 0.0;
  double shear = 1.0;
};

Measures measure(const Triangle& t, std::span<const Vector3d> positions,
                 std::span<const Vector2d> points) {
  const Vector3d u = positions[t[1]] - positions[t[0]];
  const Vector3d v = positions[t[2]] - positions[t[0]];
  Matrix2d plane;
  plane << points[t[1]] - points[t[0]], points[t[2]] - points[t[0]];
  Measures measures;
  measures.surface_area = 0.5 * u.cross(v).norm();
  measures.plane_area = 0.5 * std::abs(plane.determinant());
  // The first fundamental form is J'J with J = [u v] plane^-1. Its trace and determinant are the
  // sum and the product of its eigenvalues G^2 and g^2.
  Matrix2d gram;
  gram << u.squaredNorm(), u.dot(v), u.dot(v), v.squaredNorm();
  const Matrix2d inverse = plane.inverse();
  measures.squared_stretch = 0.5 * (inverse.transpose() * gram * inverse).trace();
  const double product = measures.surface_area / measures.plane_area;
  const double ratio = measures.squared_stretch / product;
  measures.shear = ratio + std::sqrt(std::max(0.0, (ratio - 1.0) * (ratio + 1.0)));
  return measures;
}

// The new polygons, and the local index of each of their corners.
class Recut {
 public:
  Recut(const Mesh& mesh, const Patch& patch)
      : mesh_(mesh), topology_(mesh.topology()), patch_(patch) {
    const Topology& topology = mesh.topology();
    std::size_t triangle = 0;
    CancelCheck cancel_check;
    for (Index f = 0; f < mesh.face_count(); ++f) {
      cancel_check();
      const std::size_t first = triangle;
      while (triangle < topology.triangles.size() && topology.triangle_faces[triangle] == f) {
        ++triangle;
      }
      add_face(f, first, triangle);
    }
  }

  FaceSources sources;
  std::vector<Index> own_numbers;

 private:
  // Returns the patch's triangles inside a triangle of the mesh.
  std::span<const Triangle> parts(std::size_t triangle) const {
    const auto& all = patch_.triangle_sources;
    const auto [first, last] = std::equal_range(all.begin(), all.end(), triangle);
    return std::span(patch_.triangles)
        .subspan(static_cast<std::size_t>(first - all.begin()),
                 static_cast<std::size_t>(last - first));
  }

  void add_face(Index face, std::size_t first, std::size_t last) {
    bool is_inside = first < last;
    bool is_cut = false;
    for (std::size_t t = first; t < last; ++t) {
      is_inside = is_inside && !parts(t).empty();
      is_cut = is_cut || parts(t).size() > 1;
    }
    if (!is_cut) {
      for (Index c = mesh_.face_starts()[face]; c < mesh_.face_starts()[face + 1]; ++c) {
        add_corner(c, is_inside ? patch_.own_number(mesh_.face_vertices()[c]) : kNoIndex);
      }
      end_face(face);
      return;
    }
    for (std::size_t t = first; t < last; ++t) {
      for (const Triangle& part : parts(t)) {
        for (const Index own : part) add_corner(corner_of(face, mesh_vertex(own)), own);
        end_face(face);
      }
      if (!parts(t).empty()) continue;
      for (const Index v : topology_.triangles[t]) add_corner(corner_of(face, v), kNoIndex);
      end_face(face);
    }
  }

  // Returns the mesh vertex. For an edge midpoint, returns the end vertex from which it takes its
  // attributes.
  Index mesh_vertex(Index own) const {
    const std::size_t n = patch_.vertices.size();
    return patch_.vertices[own < n ? own : patch_.midpoint_of[own - n][0]];
  }
  Index corner_of(Index face, Index vertex) const {
    const auto polygon = mesh_.face(face);
    const auto at = std::find(polygon.begin(), polygon.end(), vertex) - polygon.begin();
    return mesh_.face_starts()[face] + static_cast<Index>(at);
  }

  void add_corner(Index corner, Index own) {
    sources.corners.push_back(corner);
    own_numbers.push_back(own);
  }
  void end_face(Index face) {
    sources.faces.push_back(face);
    sources.starts.push_back(static_cast<Index>(sources.corners.size()));
  }

  const Mesh& mesh_;
  const Topology& topology_;
  const Patch& patch_;
};

BoundaryPins own_pins(const ParameterizeRequest& request, const Patch& patch) {
  BoundaryPins pins;
  for (const Index v : request.pins) {
    pins.push_back(patch.own_number(v));
    if (pins.back() != kNoIndex) continue;
    throw InputError(request.where + ": vertex " + std::to_string(v) +
                         " is not in the patch; choose a vertex on its boundary, such as vertex " +
                         std::to_string(patch.vertices[patch.loop.front()]),
                     {v});
  }
  return pins;
}

std::vector<Eigen::Vector2d> uvs_of(const DomainMap& map) {
  std::vector<Eigen::Vector2d> uvs = map.points;
  if (map.domain == Domain::square) return uvs;
  for (Eigen::Vector2d& uv : uvs) uv = 0.5 * (uv + Eigen::Vector2d(1, 1));
  return uvs;
}

}  // namespace

MapDistortion measure_distortion(std::span<const Triangle> triangles,
                                 std::span<const Vector3d> positions,
                                 std::span<const Vector2d> points) {
  MapDistortion distortion;
  double surface_area = 0.0;
  double plane_area = 0.0;
  double squared_stretch = 0.0;
  double largest = 0.0;
  double shear = 0.0;
  CancelCheck cancel_check;
  for (const Triangle& t : triangles) {
    cancel_check();
    const Measures m = measure(t, positions, points);
    if (!(m.surface_area > 0.0) || !std::isfinite(m.squared_stretch) || !std::isfinite(m.shear)) {
      continue;
    }
    surface_area += m.surface_area;
    plane_area += m.plane_area;
    squared_stretch += m.surface_area * m.squared_stretch;
    largest = std::max(largest, m.squared_stretch);
    shear += m.surface_area * m.shear;
    distortion.largest_shear = std::max(distortion.largest_shear, m.shear);
  }
  if (!(surface_area > 0.0)) return distortion;
  const double size_ratio = plane_area / surface_area;
  distortion.stretch = std::sqrt(squared_stretch / surface_area * size_ratio);
  distortion.largest_stretch = std::sqrt(largest * size_ratio);
  distortion.shear = shear / surface_area;
  return distortion;
}

Mesh with_uvs(const Mesh& mesh, const Patch& patch, std::span<const Eigen::Vector2d> uvs) {
  const Recut recut(mesh, patch);
  Mesh result = mesh;
  replace_faces(result, recut.sources);
  const std::size_t n = patch.vertices.size();
  std::vector<Index> vertices(mesh.vertex_count());
  std::iota(vertices.begin(), vertices.end(), Index{0});
  for (const auto& ends : patch.midpoint_of) vertices.push_back(patch.vertices[ends[0]]);
  replace_vertices(result, vertices);
  for (std::size_t m = 0; m < patch.midpoint_of.size(); ++m) {
    const auto [a, b] = patch.midpoint_of[m];
    result.positions[mesh.vertex_count() + m] =
        0.5 * (mesh.positions[patch.vertices[a]] + mesh.positions[patch.vertices[b]]);
  }
  std::vector<Index>& vertex_of = result.edit_faces().vertices;
  for (std::size_t c = 0; c < recut.own_numbers.size(); ++c) {
    const Index own = recut.own_numbers[c];
    if (own == kNoIndex || own < n) continue;
    vertex_of[c] = static_cast<Index>(mesh.vertex_count() + own - n);
  }
  MeshAttributes& attributes = result.edit_attributes();
  attributes.uvs.assign(uvs.begin(), uvs.end());
  attributes.corner_uvs = recut.own_numbers;
  return result;
}

Parameterized parameterize(const Mesh& mesh, const ParameterizeRequest& request,
                           const Progress& progress) {
  const ProgressScope scope(progress);
  const Topology& topology = mesh.topology();
  Parameterized result;
  result.patch =
      disk_patch(resolve(request.region, mesh), topology, mesh.positions, request.region.where);
  const Patch& patch = result.patch;
  result.positions = on_patch(patch, std::span<const Eigen::Vector3d>(mesh.positions));
  result.pins = request.pins.empty() ? default_pins(patch, result.positions, request.domain)
                                     : own_pins(request, patch);
  result.map = mean_value_map(patch, result.positions, request.domain, result.pins);
  result.flipped = flipped_triangles(patch.triangles, result.map.points);
  result.distortion = measure_distortion(patch.triangles, result.positions, result.map.points);
  result.mesh = with_uvs(mesh, patch, uvs_of(result.map));
  if (!result.flipped.empty()) {
    result.warnings.push_back(
        "the map shrinks some triangles below rounding precision, so they are flipped, the first "
        "in triangle " +
        std::to_string(patch.triangle_sources[result.flipped.front()]) +
        "; choose a region with a longer boundary, or another domain");
  }
  return result;
}

}  // namespace lapwing
