#include "lapwing/parameterize/parameterize.h"

#include "lapwing/base/cancellation.h"
#include "lapwing/base/errors.h"
#include "lapwing/parameterize/uv_mesh.h"

namespace lapwing {
namespace {

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
