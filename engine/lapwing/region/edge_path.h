#pragma once

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

}  // namespace lapwing
