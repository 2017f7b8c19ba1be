#pragma once

#include <cstdint>
#include <vector>

#include "lapwing/deform/handle_motion.h"
#include "lapwing/mesh/mesh.h"
#include "lapwing/settle/settle.h"

namespace lapwing {

/// Where a settled drag is: what its next frame begins with. Empty where it begins at rest.
struct SettledPose {
  /// The handles' motions. A handle with free orientation has the rotation that was found.
  HandleMotions motions;
  std::vector<double> parameters;        ///< of `motions`
  Positions displacement;                ///< of the whole mesh
  SettleResult settled;                  ///< how the last frame ended
  /// What the last frames changed in parameters and displacement, each counted by half of the next:
  /// how the surface goes on when the handles do. Empty where the last frame was the first.
  std::vector<double> recent_parameters;
  Positions recent_displacement;
  /// Among all frames of the program, from 1; 0 for a pose that no frame came to.
  std::uint64_t frame = 0;
};

}  // namespace lapwing
