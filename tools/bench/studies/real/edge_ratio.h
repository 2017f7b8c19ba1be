#pragma once

#include <span>

#include "lapwing/mesh/topology.h"

namespace lapwing::bench {

/// Returns the largest length over rest length of the ring edges of `rows`; 1 means no stretch.
/// Ignores edges without length at rest. Returns 0 if there are no edges.
double largest_edge_ratio(std::span<const Index> rows, const Topology& topology,
                          std::span<const Eigen::Vector3d> rest,
                          std::span<const Eigen::Vector3d> current);

}  // namespace lapwing::bench
