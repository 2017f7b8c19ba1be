#include "lapwing/deform/modifiers/resolved_request.h"

#include <algorithm>

namespace lapwing {
namespace {

Eigen::AngleAxisd turn_by(const AxisRotation& turn) {
  return {turn.degrees * std::numbers::pi / 180.0, turn.axis};
}

}  // namespace

std::vector<HandleMotions> ResolvedRequest::path() const {
  std::size_t count = 0;
  for (const MovedHandle& handle : request.handles) count = std::max(count, handle.path.size());
  std::vector<HandleMotions> path;
  for (std::size_t k = 0; k < count; ++k) {
    const double share = static_cast<double>(k + 1) / static_cast<double>(count + 1);
    HandleMotions motions = handle_motions(0.0, share);
    for (std::size_t h = 0; h < request.handles.size(); ++h) {
      const MovedHandle& handle = request.handles[h];
      if (handle.path.empty()) continue;
      motions.maps[h] = to_affine(handle.path[k], centroids[h]);
      motions.turns[h] = turn_by(turn_of(handle.path[k]));
    }
    path.push_back(std::move(motions));
  }
  return path;
}

}  // namespace lapwing
