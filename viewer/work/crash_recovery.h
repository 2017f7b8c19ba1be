#pragma once

#include "lapwing/base/cancellation.h"
#include "lapwing/kernels/kernels.h"
#include "state/journal.h"

namespace lapwing::viewer {

/// Restores an edit after a crash. `start` is the state of `edit.mesh` before any step. If the
/// journal contains the result of a deform, the restored positions are bitwise identical to it.
/// Steps that were undone before the crash can be redone, if they can be carried out again. All
/// other steps are carried out as in a run of the recipe. Throws the errors of `from_draft`.
History restore_after_crash(AppState start, const InterruptedEdit& edit, Kernels& kernels,
                            const Progress& progress = {});

}  // namespace lapwing::viewer
