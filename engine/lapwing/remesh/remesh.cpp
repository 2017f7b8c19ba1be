#include "lapwing/remesh/remesh.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include <Eigen/Geometry>

#include "lapwing/base/cancellation.h"
#include "lapwing/base/errors.h"
#include "lapwing/mesh/edges.h"
#include "lapwing/mesh/mesh.h"

namespace lapwing {
namespace {

double smallest_angle(const Mesh& mesh, std::span<const Index> face) {
  double smallest = std::numbers::pi;
  for (std::size_t i = 0; i < face.size(); ++i) {
    const Eigen::Vector3d& p = mesh.positions[face[i]];
    const Eigen::Vector3d to = mesh.positions[face[(i + 1) % face.size()]] - p;
    const Eigen::Vector3d from = mesh.positions[face[(i + face.size() - 1) % face.size()]] - p;
    smallest = std::min(smallest, std::atan2(to.cross(from).norm(), to.dot(from)));
  }
  return smallest * 180.0 / std::numbers::pi;
}

double wanted_length(const RemeshRequest& request, const RegionQuality& before) {
  // Without faces nothing is remeshed, so the length has no effect.
  if (before.faces == 0) return 1.0;
  if (request.length) return *request.length;
  // Some positions are not finite; `remesh_isotropic` throws an error that names the vertices.
  if (!std::isfinite(before.mean_edge)) return 1.0;
  if (before.mean_edge > 0.0) return request.scale * before.mean_edge;
  throw InputError(request.where +
                   ": the region's edges have length 0, so a scale has no effect; give a length");
}

}  // namespace

RegionQuality region_quality(const Mesh& mesh, const VertexSet& region) {
  RegionQuality quality;
  const std::vector<char> inside = vertex_mask(mesh.vertex_count(), region);
  std::vector<char> is_used(mesh.vertex_count(), 0);
  std::vector<unsigned char> use_face(mesh.face_count(), 0);
  double smallest = 180.0;
  CancelCheck cancel_check;
  for (std::size_t f = 0; f < mesh.face_count(); ++f) {
    cancel_check();
    const auto face = mesh.face(f);
    use_face[f] = std::ranges::all_of(face, [&](Index v) { return inside[v] != 0; });
    if (!use_face[f]) continue;
    ++quality.faces;
    smallest = std::min(smallest, smallest_angle(mesh, face));
    for (const Index v : face) is_used[v] = 1;
  }
  quality.vertices = static_cast<std::size_t>(std::ranges::count(is_used, 1));
  if (quality.faces == 0) return quality;
  quality.smallest_angle_degrees = smallest;
  const Edges edges = build_edges(mesh, use_face);
  for (const auto& [a, b] : edges.ends) {
    quality.mean_edge += (mesh.positions[a] - mesh.positions[b]).norm();
  }
  if (edges.count() > 0) quality.mean_edge /= static_cast<double>(edges.count());
  return quality;
}

Remeshed remesh(const Mesh& mesh, const RemeshRequest& request, const Progress& progress) {
  const ProgressScope scope(progress);
  const VertexSet region = resolve(request.region, mesh);
  require_extent(region, mesh.positions, request.region.where);
  Remeshed result;
  result.before = region_quality(mesh, region);
  const double length = wanted_length(request, result.before);
  RemeshResult done = remesh_isotropic(
      mesh, region, [&](const Eigen::Vector3d&) { return length; }, request.options, progress);
  result.mesh = std::move(done.mesh);
  result.kept = std::move(done.kept);
  result.region = std::move(done.region);
  result.after = region_quality(result.mesh, result.region);
  if (!done.note.empty()) result.warnings.push_back(std::move(done.note));
  return result;
}

}  // namespace lapwing
