#pragma once

#include <cstddef>
#include <optional>

#include "lapwing/laplacian/energy_weights.h"

namespace lapwing {

/// Unit: the radius of gyration of the region (EnergyTerms::detail_length). Chosen on the meshes of
/// `lapwing-bench real` and on a rippled tube. Smaller values lose more detail on the tube; larger
/// values lose more detail and flip more triangles on the meshes.
inline constexpr double kDefaultDetailLength = 0.077;

/// Range of `detail_length`. Its square is the ratio of the two sums of the energy. Outside this
/// range, the smaller sum is lost in double precision when both are added.
inline constexpr double kLeastDetailLength = 1e-6;
inline constexpr double kMostDetailLength = 1e3;

/// The linear system from which linear drags are computed.
enum class LinearResponse {
  tangent,  ///< the energy to second order at rest, with the rotations eliminated
  rsi,      ///< equation 10 of the paper: every ring rotates and scales freely
};

struct SettleOptions {
  /// The surface is settled if the next step moves no vertex farther than this, in mean edge
  /// lengths.
  double tolerance = 1e-4;
  int max_iterations = 200;

  bool operator==(const SettleOptions&) const = default;
};

struct DeformOptions {
  LaplacianWeights weights = LaplacianWeights::cotangent;
  /// See EnergyTerms::detail_length. From kLeastDetailLength to kMostDetailLength. Has no effect on
  /// the RSI system.
  double detail_length = kDefaultDetailLength;
  LinearResponse response = LinearResponse::tangent;
  /// The weight of the soft constraints on handles and belt, at most kMaxWeight. The paper (eq. 5)
  /// uses 1. If it is empty, the constraints are stiff (kStiff), and the handle error is less than
  /// a hundredth of the motion on every mesh. Hard constraints ignore the weight.
  std::optional<double> constraint_weight = {};
  /// Handle and belt vertices reach their positions exactly instead of in the least-squares sense.
  bool hard = false;
  /// Memory limit of the 3n x 3n system; 0: `allowed_memory` at the time of its preparation. If the
  /// system needs more memory, edits with `settle` do without it, and linear drags use a
  /// DragPreview.
  std::size_t memory_limit_bytes = 0;
  /// Options of the minimization of the energy, which preserves details under large rotations.
  /// Empty: computes the linear response, which is accurate only for small angles.
  std::optional<SettleOptions> settle = SettleOptions{};
  bool operator==(const DeformOptions&) const = default;
};

}  // namespace lapwing
