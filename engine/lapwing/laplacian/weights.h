#pragma once

#include <span>
#include <vector>

#include "lapwing/base/numbers.h"
#include "lapwing/mesh/topology.h"

namespace lapwing {

/// How the mean of a ring is taken in L(v_i) = v_i - sum_j w_ij v_j.
enum class LaplacianWeights {
  uniform,    ///< w_ij = 1 / |N_i|, the paper's
  cotangent,  ///< w_ij proportional to cot a_ij + cot b_ij, the angles opposite edge ij
};

/// One weight per entry of `topology.rings`, each row summing to 1 (a row without entries is
/// empty). Cotangents count up to kLargestCotangent, and weights are made positive: an edge counts
/// at least kSmallestCotangentShare of its row's mean absolute weight. Without that an obtuse
/// triangle gives a negative weight, and a row of them can sum to nothing, which takes the row's
/// diagonal away. Rows without any cotangent (all neighbours at one place) fall back to uniform
/// weights. Linear time.
std::vector<double> laplacian_weights(const Topology& topology,
                                      std::span<const Eigen::Vector3d> positions,
                                      LaplacianWeights scheme);
/// The same of `rows` alone, in time that is theirs: entries of other rows are there, but
/// undefined.
Numbers laplacian_weights(const Topology& topology, std::span<const Eigen::Vector3d> positions,
                          LaplacianWeights scheme, std::span<const Index> rows);
/// The cotangent ones of `rows` where their `cotangent_sums` are known.
Numbers laplacian_weights(const Topology& topology, const Numbers& cotangent_sums,
                          std::span<const Index> rows);

/// One weight per entry of `topology.rings`, the same from both ends of an edge: cot a_ij + cot
/// b_ij, made positive as above by the mean over all edges, and scaled so that their mean is 1. All
/// 1 on a mesh without area. Linear time.
std::vector<double> edge_weights(const Topology& topology,
                                 std::span<const Eigen::Vector3d> positions);

/// Small enough to leave ordinary meshes alone, large enough that every neighbour still holds.
inline constexpr double kSmallestCotangentShare = 0.01;

/// That of an angle of 0.006 degrees: below that rounding decides, so triangles without any area
/// count by it, too, unless two of their corners are at one place. Slivers keep their large
/// weights, which hold them together: with a limit at 2 degrees 17 of 188 edits of real meshes had
/// flipped triangles, with this one 11.
inline constexpr double kLargestCotangent = 1e4;

/// cot a_ij + cot b_ij per entry of `topology.rings`, as they are: of any sign. Linear time.
std::vector<double> cotangent_sums(const Topology& topology,
                                   std::span<const Eigen::Vector3d> positions);
/// The same of `rows` alone; undefined in others.
Numbers cotangent_sums(const Topology& topology, std::span<const Eigen::Vector3d> positions,
                       std::span<const Index> rows);

}  // namespace lapwing
