#pragma once

#include <optional>

#include "lapwing/coating/coater.h"
#include "lapwing/coating/correspondence.h"

namespace lapwing {

/// Whether a step may change the triangles of its patch.
enum class Remeshing {
  automatic,  ///< where the patch is too coarse for what comes to it
  none,
};

/// How a coat step is computed, whatever patches it concerns. Lengths are on the mesh they name.
struct CoatParameters {
  double detail_size = 0.0;    ///< above 0; on the source: what is smaller is coating
  double smooth_target = 0.0;  ///< 0: the target keeps its own detail
  LaplacianWeights weights = LaplacianWeights::cotangent;
  CorrespondenceOptions correspondence;
  CoatOptions sampling;
  double amplitude = 1.0;
  /// On the target; none: as wide as `detail_size` is there, and smooth.
  std::optional<Transition> transition;
  Remeshing remesh = Remeshing::automatic;
  bool operator==(const CoatParameters&) const = default;
};

}  // namespace lapwing
