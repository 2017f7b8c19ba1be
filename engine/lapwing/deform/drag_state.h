#pragma once

#include "lapwing/deform/handle_motion.h"
#include "lapwing/elastic/minimizer_result.h"
#include "lapwing/mesh/mesh.h"

namespace lapwing {

/// A pose of a surface during or after a drag. Empty at rest.
struct DragState {
  /// The handles' motions. A handle with free orientation has the rotation that was found.
  HandleMotions motions;
  Positions displacement;  ///< of the whole mesh, from rest
  MinimizerResult last_result;  ///< of the last frame's minimization

  bool empty() const { return motions.maps.empty(); }
};

}  // namespace lapwing
