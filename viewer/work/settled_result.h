#pragma once

#include <memory>
#include <vector>

#include "lapwing/base/cancellation.h"
#include "lapwing/deform/deform_solver.h"
#include "lapwing/deform/drag.h"
#include "lapwing/kernels/kernels.h"
#include "state/draft.h"
#include "work/attachment_cache.h"

namespace lapwing::viewer {

/// The result of settling.
struct SettledResult {
  std::vector<HandleMove> moves;               ///< those of the state that asked
  std::shared_ptr<const MovedVertices> moved;  ///< certified
};

/// Computes the result of the state's moves with `solver`, which was prepared for it: from the pose
/// `from` if that is of the same region, and otherwise as a run of the recipe does. Throws what
/// these throw.
SettledResult settled_result(const AppState& state, const DragState* from,
                             const DeformSolver& solver, Kernels& kernels,
                             AttachmentCache& contacts, const Progress& progress);

/// Makes `solved` the result of the state, and carries along the files that follow the surface.
std::shared_ptr<const MovedVertices> certified_result(const AppState& state,
                                                      const DeformSolver& solver,
                                                      DeformResult solved,
                                                      AttachmentCache& contacts,
                                                      const Progress& progress);

}  // namespace lapwing::viewer
