#pragma once

#include <cstddef>
#include <optional>

#include "lapwing/laplacian/energy_weights.h"

namespace lapwing {

/// In radii of gyration of the region (EnergyTerms::detail_length). Chosen on the meshes of
/// `lapwing-bench real` and a rippled tube: smaller loses more detail on the tube, larger loses
/// more and flips more triangles on the meshes.
inline constexpr double kDefaultDetailLength = 0.077;

/// Range of `detail_length`. Its square is the ratio of the two sums of the energy. Outside this
/// range, the smaller sum is lost in double precision when both are added.
inline constexpr double kLeastDetailLength = 1e-6;
inline constexpr double kMostDetailLength = 1e3;

/// The linear system of a drag's response.
enum class LinearResponse {
  tangent,  ///< the energy to second order at rest, its rotations eliminated
  rsi,      ///< equation 10 of the paper: every ring turns and scales freely
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
  /// As EnergyTerms::detail_length, in its range. Has no effect on the RSI system.
  double detail_length = kDefaultDetailLength;
  LinearResponse response = LinearResponse::tangent;
  /// The weight of the soft constraints on handles and belt, at most kMaxWeight. In eq. 5, the
  /// weight is 1. If it is empty, the constraints are stiff (kStiff), and the handle error is less
  /// than a hundredth of the motion on every mesh. Hard constraints ignore the weight.
  std::optional<double> constraint_weight = {};
  /// Handle and belt vertices reach their positions exactly, not in the least-squares sense.
  bool hard = false;
  /// Memory limit of the 3n x 3n system; 0 for `allowed_memory` at its preparation. If it needs
  /// more, an edit that settles runs without it, and its linear drags use a DragPreview.
  std::size_t memory_limit_bytes = 0;
  /// Minimizes the energy, so that details survive large rotations. Empty for the linear response,
  /// which is right for small angles only.
  std::optional<SettleOptions> settle = SettleOptions{};
  bool operator==(const DeformOptions&) const = default;
};

}  // namespace lapwing
