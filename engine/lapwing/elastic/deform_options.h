#pragma once

#include <cstddef>
#include <optional>

#include "lapwing/elastic/settle_options.h"
#include "lapwing/laplacian/energy_weights.h"
#include "lapwing/solve/block_solver.h"

namespace lapwing {

/// Of a region's radius of gyration (EnergyTerms::detail_length). Chosen on the meshes of
/// `lapwing-bench real` and a rippled tube: smaller loses more detail on the tube, larger loses
/// more and flips more triangles on the meshes.
inline constexpr double kDefaultDetailLength = 0.077;

/// What `detail_length` may be. Farther out the two sums of the energy, whose ratio is its square,
/// are so unlike that double precision does not hold the smaller one beside the larger.
inline constexpr double kLeastDetailLength = 1e-6;
inline constexpr double kMostDetailLength = 1e3;

/// The linear system that a drag's response comes from.
enum class LinearResponse {
  tangent,  ///< the energy to second order at rest, its rotations eliminated
  rsi,      ///< the paper's, equation 10: every ring turns and scales as it likes
};

struct DeformOptions {
  LaplacianWeights weights = LaplacianWeights::cotangent;
  /// As EnergyTerms::detail_length, in its range. Has no effect on the RSI system.
  double detail_length = kDefaultDetailLength;
  LinearResponse response = LinearResponse::tangent;
  /// How strongly handle and belt hold (eq. 5 has 1), in the range of weights (kMostWeight). Has no
  /// effect on hard constraints.
  double constraint_weight = 1.0;
  /// Handle and belt vertices go exactly where they should, rather than in the least squares.
  bool hard = false;
  /// The memory that the 3n x 3n system may take; 0 for what `allowed_memory` says when it is
  /// prepared. If it needs more, an edit that settles runs without it, and its linear drags are a
  /// DragPreview's.
  std::size_t memory_limit_bytes = 0;
  /// Minimizes the energy, so that details survive large rotations; none for the linear response,
  /// which is right for small angles only.
  std::optional<SettleOptions> settle = SettleOptions{};
  bool operator==(const DeformOptions&) const = default;
};

}  // namespace lapwing
