#pragma once

#include <memory>
#include <vector>

#include "lapwing/base/progress.h"
#include "lapwing/deform/deform_solver.h"
#include "lapwing/deform/drag_state.h"
#include "lapwing/kernels/kernels.h"
#include "state/draft.h"
#include "state/journal.h"
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

/// Restores the steps of an interrupted edit: a deform whose result was kept has the same bits
/// again, everything else is carried out as in a run. `edit` and `kernels` must outlive the
/// returned object.
CarryOut carry_out_again(const InterruptedEdit& edit, Kernels& kernels, Progress progress = {});

}  // namespace lapwing::viewer
