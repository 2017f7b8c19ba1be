#pragma once

#include <span>
#include <vector>

#include "lapwing/base/numbers.h"
#include "lapwing/mesh/topology.h"

namespace lapwing {

/// The weights of a ring in L(v_i) = v_i - sum_j w_ij v_j.
enum class LaplacianWeights {
  uniform,    ///< w_ij = 1 / |N_i|, as in the paper
  cotangent,  ///< w_ij proportional to cot a_ij + cot b_ij, the angles opposite edge ij
};

/// Returns one weight per entry of `topology.rings`. The weights of each row sum to 1. Cotangents
/// are clamped to kLargestCotangent. Each weight is at least kSmallestCotangentShare times the mean
/// absolute weight of its row. Without this lower bound, obtuse triangles would give negative
/// weights, and a row could sum to 0. Rows in which no cotangent is defined, because all neighbours
/// coincide, get uniform weights. Takes linear time.
std::vector<double> laplacian_weights(const Topology& topology,
                                      std::span<const Eigen::Vector3d> positions,
                                      LaplacianWeights scheme);
/// Returns the same weights, but computes only those of `rows`, in time linear in their size.
/// Entries of other rows are undefined.
Numbers laplacian_weights(const Topology& topology, std::span<const Eigen::Vector3d> positions,
                          LaplacianWeights scheme, std::span<const Index> rows);
/// Returns the cotangent weights of `rows` from their `cotangent_sums`.
Numbers laplacian_weights(const Topology& topology, const Numbers& cotangent_sums,
                          std::span<const Index> rows);

/// Returns one weight per entry of `topology.rings`, the same from both ends of an edge: cot a_ij +
/// cot b_ij, made positive as above by the mean over all edges, and scaled to a mean of 1. All are
/// 1 on a mesh without area. Linear time.
std::vector<double> edge_weights(const Topology& topology,
                                 std::span<const Eigen::Vector3d> positions);

/// This value is so small that it does not change ordinary meshes, and so large that every
/// neighbour has an effect.
inline constexpr double kSmallestCotangentShare = 0.01;

/// The cotangent of 0.006 degrees. Below this angle rounding decides, so triangles without area get
/// this limit too, unless two of their corners coincide. Slivers keep their large weights, which
/// hold them together: with a limit at 2 degrees, 17 of 188 edits of real meshes had flipped
/// triangles; with this one, 11.
inline constexpr double kLargestCotangent = 1e4;

/// Returns cot a_ij + cot b_ij for each entry of `topology.rings`. The sum may be negative. Only
/// the entries of `rows` are computed; the others are undefined.
Numbers cotangent_sums(const Topology& topology, std::span<const Eigen::Vector3d> positions,
                       std::span<const Index> rows);

}  // namespace lapwing
