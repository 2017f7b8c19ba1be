#pragma once

#include <functional>
#include <span>
#include <vector>

#include "lapwing/mesh/topology.h"

namespace lapwing {

/// The shortest path from `from` to `to` along edges (Dijkstra), both ends included; only `from`
/// when they are equal, and empty when no path leads. Of equally short paths always the same one.
/// Explores no farther than the distance of `to`. Throws InputError when an end is not a vertex.
std::vector<Index> shortest_edge_path(const Topology& topology,
                                      std::span<const Eigen::Vector3d> positions, Index from,
                                      Index to);

/// A search for a path over `rings`.
struct PathSearch {
  std::function<bool(Index)> ends_at;
  std::function<bool(Index)> may_reach;  ///< beside the starts
};
/// The shortest path from one of `starts` to the nearest vertex where the search ends.
std::vector<Index> shortest_edge_path(const Adjacency& rings,
                                      std::span<const Eigen::Vector3d> positions,
                                      std::span<const Index> starts, const PathSearch& search);

}  // namespace lapwing
