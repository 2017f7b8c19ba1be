#pragma once

#include <optional>

#include "lapwing/laplacian/weights.h"
#include "lapwing/parameterize/domain_map.h"
#include "lapwing/region/transition.h"

namespace lapwing {

/// Whether a step may change the triangles of its patch.
enum class Remeshing {
  automatic,  ///< where the patch is too coarse for what comes to it
  none,
};

/// How a coat or mix step treats its target, whatever comes to it. Lengths are on the target.
struct CoatParameters {
  double smooth_target = 0.0;  ///< 0: the target keeps its own detail
  LaplacianWeights weights = LaplacianWeights::cotangent;
  Domain domain = Domain::disk;  ///< what sources and target are laid into
  /// None: as wide as the source's detail size is there, and smooth.
  std::optional<Transition> transition;
  Remeshing remesh = Remeshing::automatic;
  bool operator==(const CoatParameters&) const = default;
};

}  // namespace lapwing
