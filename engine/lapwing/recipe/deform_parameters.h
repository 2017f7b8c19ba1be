#pragma once

#include <optional>

#include "lapwing/deform/deform_options.h"

namespace lapwing {

/// How a deform step is computed, whatever it moves.
struct DeformParameters {
  LaplacianWeights weights = LaplacianWeights::uniform;
  double constraint_weight = 1.0;  ///< above 0
  bool hard = false;               ///< belt and handles held exactly, not by weight
  std::optional<SettleOptions> settle = SettleOptions{};  ///< none: the linear solution as it is
  /// A larger turn of a handle is made in equal parts of at most this many degrees, each committed:
  /// its result is the rest shape of the next. Above 0, at most kLargestSettledTurnDegrees.
  std::optional<double> commit_every = {};
  bool operator==(const DeformParameters&) const = default;
};

/// What a Deformer needs of them, for the step or each of its parts.
inline DeformOptions deform_options(const DeformParameters& parameters) {
  DeformOptions options;
  options.weights = parameters.weights;
  options.constraint_weight = parameters.constraint_weight;
  options.hard = parameters.hard;
  options.settle = parameters.settle;
  return options;
}

}  // namespace lapwing
