#pragma once

#include <optional>
#include <vector>

#include "lapwing/deform/deform_options.h"
#include "lapwing/deform/move.h"
#include "lapwing/region/border_belt.h"
#include "lapwing/region/region_spec.h"

namespace lapwing {

/// How a deformation is computed, whatever it moves.
struct DeformParameters {
  // As the options of that name.
  LaplacianWeights weights = DeformOptions{}.weights;
  double detail_length = DeformOptions{}.detail_length;  ///< above 0
  LinearResponse response = DeformOptions{}.response;
  double constraint_weight = DeformOptions{}.constraint_weight;  ///< above 0
  bool hard = DeformOptions{}.hard;
  std::optional<SettleOptions> settle = DeformOptions{}.settle;
  /// A larger turn of a handle is made in equal parts of at most this many degrees, each committed:
  /// its result is the rest shape of the next. Above 0, at most kLargestSettledTurnDegrees.
  std::optional<double> commit_every = {};
  bool operator==(const DeformParameters&) const = default;
};

/// What a Deformer needs of them, for the whole request or each of its parts.
inline DeformOptions deform_options(const DeformParameters& parameters) {
  DeformOptions options;
  options.weights = parameters.weights;
  options.detail_length = parameters.detail_length;
  options.response = parameters.response;
  options.constraint_weight = parameters.constraint_weight;
  options.hard = parameters.hard;
  options.settle = parameters.settle;
  return options;
}

struct MovedHandle {
  RegionSpec region;
  Move move;
  bool operator==(const MovedHandle&) const = default;
};

/// Bend the ROI by moving its handles: all of an edit but the mesh. {"op": "deform"} in recipes.
struct DeformRequest {
  RegionSpec roi;
  BeltSpec belt = BorderBelt{};
  std::vector<MovedHandle> handles;  ///< at least one
  DeformParameters parameters;
  bool operator==(const DeformRequest&) const = default;
};

}  // namespace lapwing
