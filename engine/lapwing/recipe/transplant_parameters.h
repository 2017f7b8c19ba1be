#pragma once

#include <optional>
#include <variant>

#include "lapwing/coating/transition.h"
#include "lapwing/deform/move.h"
#include "lapwing/kernels/kernels.h"
#include "lapwing/laplacian/weights.h"
#include "lapwing/recipe/coat_parameters.h"
#include "lapwing/transplant/fit_loop.h"

namespace lapwing {

/// Where a part comes to: by itself, its loop on that of the hole; or moved from where it is in its
/// file, a move without pivot about the centre of the part's loop.
using PartPlace = std::variant<LoopFit, Move>;

/// How a transplant step is computed. Lengths are on the mesh that the part is put on.
struct TransplantParameters {
  /// How far over the part the host's detail goes over into the part's; none: half the radius of
  /// the hole, and smooth.
  std::optional<Transition> transition;
  std::optional<double> padding;  ///< free on both sides beyond it; none: half the transition
  std::optional<double> belt;     ///< held beyond that; none: a quarter of it
  LaplacianWeights weights = LaplacianWeights::cotangent;
  MappedSampling sampling = MappedSampling::linear;
  Remeshing remesh = Remeshing::automatic;
  bool operator==(const TransplantParameters&) const = default;
};

}  // namespace lapwing
