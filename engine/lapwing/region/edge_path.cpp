#include "lapwing/region/edge_path.h"

#include <algorithm>
#include <functional>
#include <limits>
#include <queue>
#include <string>
#include <unordered_map>
#include <utility>

#include "lapwing/base/cancellation.h"
#include "lapwing/base/errors.h"

namespace lapwing {
namespace {

void require_end(const Topology& topology, Index v) {
  if (v < topology.vertex_count()) return;
  throw InputError("vertex " + std::to_string(v) + " cannot end a path: the mesh has " +
                       std::to_string(topology.vertex_count()) + " vertices (numbered from 0)",
                   {v});
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
  return shortest_edge_path(topology.rings, positions, {&from, 1},
                            {[&](Index v) { return v == to; }, [](Index) { return true; }});
}

std::vector<Index> shortest_edge_path(const Adjacency& rings,
                                      std::span<const Eigen::Vector3d> positions,
                                      std::span<const Index> starts, const PathSearch& search) {
  // A map instead of an array per vertex, because the paths of a loop are short on a large mesh.
  std::unordered_map<Index, Reached> reached;
  using Entry = std::pair<double, Index>;
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> queue;
  const auto offer = [&](Index v, double distance, Index from) {
    Reached& there = reached[v];
    if (!(distance < there.distance)) return;
    there = {distance, from};
    queue.emplace(distance, v);
  };
  for (const Index v : starts) offer(v, 0.0, kNoIndex);
  CancelCheck cancel_check;
  while (!queue.empty()) {
    cancel_check();
    const auto [distance, v] = queue.top();
    queue.pop();
    if (distance > reached[v].distance) continue;
    if (search.ends_at(v)) {
      std::vector<Index> path;
      for (Index at = v; at != kNoIndex; at = reached[at].from) path.push_back(at);
      std::reverse(path.begin(), path.end());
      return path;
    }
    for (const Index w : rings[v]) {
      if (search.may_reach(w)) offer(w, distance + (positions[w] - positions[v]).norm(), v);
    }
  }
  return {};
}

}  // namespace lapwing
