#pragma once

#include "lapwing/base/instruction_set.h"
#include "lapwing/solve/block_cholesky/kernels.h"

namespace lapwing::cholesky {

/// Returns the kernels of an instruction set; for `automatic`, of the fastest one of this
/// processor. Throws SolverError if the processor or this build lacks the set.
const KernelTables& kernels_for(InstructionSet set);

}  // namespace lapwing::cholesky
