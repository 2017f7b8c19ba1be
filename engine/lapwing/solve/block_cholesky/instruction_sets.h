#pragma once

#include "lapwing/base/instruction_set.h"
#include "lapwing/solve/block_cholesky/kernels.h"

namespace lapwing::cholesky {

/// The kernels for an instruction set; for `automatic` the fastest this processor has. Throws
/// SolverError when the processor, or this build, lacks it.
const KernelTables& kernels_for(InstructionSet set);

}  // namespace lapwing::cholesky
