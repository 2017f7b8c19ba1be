#include "lapwing/region/edge_path.h"

#include <algorithm>
#include <functional>
#include <limits>
#include <queue>
#include <string>
#include <unordered_map>
#include <utility>

#include "lapwing/base/errors.h"

namespace lapwing {
namespace {

void require_end(const Topology& topology, Index v) {
  if (v < topology.vertex_count()) return;
  throw InputError("vertex " + std::to_string(v) + " cannot end a path: the mesh has " +
                   std::to_string(topology.vertex_count()) + " vertices (numbered from 0)");
}

struct Reached {
  double distance = std::numeric_limits<double>::infinity();
  Index from = kNoIndex;
};

}  // namespace

std::vector<Index> shortest_edge_path(const Topology& topology,
                                      std::span<const Eigen::Vector3d> positions, Index from,
                                      Index to) {
  require_end(topology, from);
  require_end(topology, to);
  // A map, not an array per vertex: the paths of a loop are short on a large mesh.
  std::unordered_map<Index, Reached> reached;
  using Entry = std::pair<double, Index>;
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> queue;
  reached[from] = {0.0, kNoIndex};
  queue.emplace(0.0, from);
  while (!queue.empty()) {
    const auto [distance, v] = queue.top();
    queue.pop();
    if (v == to) break;
    if (distance > reached[v].distance) continue;
    for (const Index w : topology.rings[v]) {
      const double longer = distance + (positions[w] - positions[v]).norm();
      Reached& there = reached[w];
      if (longer < there.distance) {
        there = {longer, v};
        queue.emplace(longer, w);
      }
    }
  }
  std::vector<Index> path;
  const auto end = reached.find(to);
  if (end == reached.end()) return path;
  for (Index v = to; v != kNoIndex; v = reached[v].from) path.push_back(v);
  std::reverse(path.begin(), path.end());
  return path;
}

}  // namespace lapwing
