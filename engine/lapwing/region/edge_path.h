#pragma once

#include <functional>
#include <span>
#include <vector>

#include "lapwing/mesh/topology.h"

namespace lapwing {

/// Returns the shortest path from `from` to `to` along edges (Dijkstra), including both ends. The
/// path is just `from` if they are equal, and empty if they are not connected. Ties are broken
/// deterministically. Explores no farther than the distance of `to`. Throws InputError if an end is
/// not a vertex.
std::vector<Index> shortest_edge_path(const Topology& topology,
                                      std::span<const Eigen::Vector3d> positions, Index from,
                                      Index to);

/// Where a path search may go and where it ends.
struct PathSearch {
  std::function<bool(Index)> ends_at;
  std::function<bool(Index)> may_reach;  ///< not asked for the starts
};
/// Returns the shortest path from one of `starts` to the nearest vertex that `search.ends_at`
/// accepts.
std::vector<Index> shortest_edge_path(const Adjacency& rings,
                                      std::span<const Eigen::Vector3d> positions,
                                      std::span<const Index> starts, const PathSearch& search);

}  // namespace lapwing
