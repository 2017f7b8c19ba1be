#pragma once

#include <optional>

#include "lapwing/laplacian/weights.h"
#include "lapwing/parameterize/domain_map.h"
#include "lapwing/region/transition.h"

namespace lapwing {

/// Whether a step may change the triangles of its patch.
enum class Remeshing {
  automatic,  ///< if the patch is too coarse for the detail
  none,
};

/// How a coat or mix treats its target. Lengths are on the target.
struct CoatParameters {
  double smooth_target = 0.0;  ///< removes the target's detail below this; 0: none
  LaplacianWeights weights = LaplacianWeights::cotangent;
  Domain domain = Domain::disk;  ///< common domain of sources and target
  /// Default: smooth, as wide as the source's detail size on the target.
  std::optional<Transition> transition;
  Remeshing remesh = Remeshing::automatic;
  bool operator==(const CoatParameters&) const = default;
};

}  // namespace lapwing
