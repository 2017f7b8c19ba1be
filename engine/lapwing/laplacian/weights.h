#pragma once

#include <span>
#include <vector>

#include "lapwing/base/numbers.h"
#include "lapwing/mesh/topology.h"

namespace lapwing {

/// The weights of a ring in L(v_i) = v_i - sum_j w_ij v_j.
enum class LaplacianWeights {
  uniform,  ///< w_ij = 1 / |N_i|, as in the paper
  /// w_ij proportional to cot a_ij + cot b_ij, where a_ij and b_ij are the angles opposite edge ij.
  cotangent,
};

/// Returns one weight per entry of `topology.rings`. The weights of each row sum to 1. Cotangents
/// are clamped to kLargestCotangent. Each weight is at least kSmallestCotangentShare times the mean
/// absolute weight of its row. Without this lower bound, obtuse triangles would cause negative
/// weights, and a row could sum to 0. If no cotangent of a row is defined because points coincide,
/// its weights are uniform. Takes linear time.
std::vector<double> laplacian_weights(const Topology& topology,
                                      std::span<const Eigen::Vector3d> positions,
                                      LaplacianWeights scheme);
/// Like `laplacian_weights` above, but computes only the weights of `rows`, in time linear in their
/// size. The entries of all other rows are undefined.
Numbers laplacian_weights(const Topology& topology, std::span<const Eigen::Vector3d> positions,
                          LaplacianWeights scheme, std::span<const Index> rows);
/// Returns the cotangent weights of `rows` from their `cotangent_sums`.
Numbers laplacian_weights(const Topology& topology, const Numbers& cotangent_sums,
                          std::span<const Index> rows);

/// Returns one weight per entry of `topology.rings`, equal for both ends of an edge. It is cot a_ij
/// + cot b_ij, with a lower bound relative to the mean over all edges, and scaled to a mean of 1.
/// On a mesh without area, all weights are 1. Takes linear time.
std::vector<double> edge_weights(const Topology& topology,
                                 std::span<const Eigen::Vector3d> positions);

/// The lower bound of a weight, relative to the mean. It is so small that it does not affect
/// ordinary meshes, and so large that every neighbour has an effect.
inline constexpr double kSmallestCotangentShare = 0.01;

/// The cotangent of 0.006 degrees. Smaller angles are dominated by rounding errors, so triangles
/// without area also get this limit, unless two of their corners coincide. Slivers have large
/// weights, which keep them from flipping: with a limit at 2 degrees, 17 of 188 edits of real
/// meshes had flipped triangles; with this limit, 11.
inline constexpr double kLargestCotangent = 1e4;

/// Returns cot a_ij + cot b_ij for each entry of `topology.rings`. The sum may be negative.
/// Computes only the entries of `rows`; all other entries are undefined.
Numbers cotangent_sums(const Topology& topology, std::span<const Eigen::Vector3d> positions,
                       std::span<const Index> rows);

}  // namespace lapwing
