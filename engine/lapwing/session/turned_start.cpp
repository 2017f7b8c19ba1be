#include "lapwing/session/turned_start.h"

#include <algorithm>

#include "lapwing/region/geodesic.h"

namespace lapwing {
namespace {

using Eigen::Vector3d;

// Stands for the distance 0, whose inverse still can be summed.
constexpr double kNoDistance = 1e-300;

// The belt and, around the region, the vertices that its rings reach.
std::vector<Index> still_vertices(const EditRegion& region, const Topology& topology,
                                  std::span<const char> in_roi) {
  std::vector<Index> still = region.belt;
  for (const Index v : region.roi) {
    for (const Index w : topology.rings[v]) {
      if (in_roi[w] == 0) still.push_back(w);
    }
  }
  return still;
}

}  // namespace

Positions turned_start(const BoundStep& bound, std::span<const Vector3d> positions, double from,
                       double to) {
  const EditRegion& region = bound.region;
  std::vector<char> in_roi(positions.size(), 0);
  for (const Index v : region.roi) in_roi[v] = 1;
  const std::vector<Index> still = still_vertices(region, bound.topology, in_roi);
  std::vector<char> allowed = in_roi;
  for (const Index v : still) allowed[v] = 1;
  const auto distances_from = [&](std::span<const Index> sources) {
    return geodesic_distances(bound.topology, positions, sources, kNoLimit, allowed);
  };
  const std::vector<double> to_still = distances_from(still);
  std::vector<std::vector<double>> to_handle;
  for (const VertexSet& handle : region.handles) to_handle.push_back(distances_from(handle));

  Positions start(positions.begin(), positions.end());
  for (const Index v : region.roi) {
    const auto nearness = [v](const std::vector<double>& distance) {
      return 1.0 / std::max(distance[v], kNoDistance);
    };
    double total = nearness(to_still);
    for (const auto& distance : to_handle) total += nearness(distance);
    if (total == 0.0) continue;  // no path leads here
    for (std::size_t h = 0; h < to_handle.size(); ++h) {
      const double share = nearness(to_handle[h]) / total;
      start[v] += bound.motion(h, from, from + share * (to - from)) * positions[v] - positions[v];
    }
  }
  // Exactly, for hard constraints.
  for (const Index v : still) start[v] = positions[v];
  for (std::size_t h = 0; h < region.handles.size(); ++h) {
    const Eigen::Affine3d motion = bound.motion(h, from, to);
    for (const Index v : region.handles[h]) start[v] = motion * positions[v];
  }
  return start;
}

}  // namespace lapwing
