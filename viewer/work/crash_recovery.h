#pragma once

#include "lapwing/base/cancellation.h"
#include "lapwing/kernels/kernels.h"
#include "state/journal.h"

namespace lapwing::viewer {

/// Restores the work that a crash interrupted, from `start`, the state of `edit.mesh`. A deform
/// whose result is in the journal gets the same bits again. Everything else is carried out as in a
/// run. Throws what `from_draft` throws.
History restore_after_crash(AppState start, const InterruptedEdit& edit, Kernels& kernels,
                            const Progress& progress = {});

}  // namespace lapwing::viewer
