#include "lapwing/solve/block_cholesky/kernels.h"

#include <algorithm>
#include <string>

#include "lapwing/base/errors.h"

namespace lapwing::cholesky {

extern const KernelTables kBaselineKernels;
#ifdef __x86_64__
extern const KernelTables kAvx2Kernels;
extern const KernelTables kAvx512Kernels;
#endif

const KernelTables& kernels_for(InstructionSet set) {
  const auto available = available_instruction_sets();
  if (set == InstructionSet::automatic) set = available.front();
  if (std::find(available.begin(), available.end(), set) == available.end()) {
    throw SolverError("this processor or this build lacks the instruction set " +
                      std::string(instruction_set_name(set)) + "; choose automatic");
  }
#ifdef __x86_64__
  if (set == InstructionSet::avx2) return kAvx2Kernels;
  if (set == InstructionSet::avx512) return kAvx512Kernels;
#endif
  return kBaselineKernels;
}

}  // namespace lapwing::cholesky
