#pragma once

#include <span>

#include "lapwing/mesh/topology.h"

namespace lapwing::bench {

/// The largest length / length at rest of the ring edges of `rows`; 1 is kept, and what shrinks
/// does not count. Edges without length at rest do not either. 0 where there are no edges.
double largest_edge_ratio(std::span<const Index> rows, const Topology& topology,
                          std::span<const Eigen::Vector3d> rest,
                          std::span<const Eigen::Vector3d> current);

}  // namespace lapwing::bench
