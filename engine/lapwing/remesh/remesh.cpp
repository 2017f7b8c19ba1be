#include "lapwing/remesh/remesh.h"

#include <cmath>
#include <utility>

#include "lapwing/base/cancellation.h"
#include "lapwing/base/errors.h"
#include "lapwing/mesh/extent.h"

namespace lapwing {
namespace {

double wanted_length(const RemeshRequest& request, const RegionQuality& before) {
  // Without faces nothing is remeshed, whatever the length.
  if (before.faces == 0) return 1.0;
  if (request.length) return *request.length;
  // If positions are not finite, `remesh_isotropic` names the vertices.
  if (!std::isfinite(before.mean_edge)) return 1.0;
  if (before.mean_edge > 0.0) return request.scale * before.mean_edge;
  throw InputError(request.where +
                   ": the region's edges have length 0, so a scale has no effect; give a length");
}

}  // namespace

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
