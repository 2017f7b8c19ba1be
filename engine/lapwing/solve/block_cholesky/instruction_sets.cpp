#include "lapwing/solve/block_cholesky/instruction_sets.h"

#include "lapwing/base/errors.h"

namespace lapwing {
namespace cholesky {

extern const KernelTable kBaselineKernels;
#ifdef LAPWING_X86_KERNELS
extern const KernelTable kAvx2Kernels;
extern const KernelTable kAvx512Kernels;
#endif

namespace {

const KernelTable* find_kernels(InstructionSet set) {
  switch (set) {
    case InstructionSet::automatic:
      break;
    case InstructionSet::baseline:
      return &kBaselineKernels;
#ifdef LAPWING_X86_KERNELS
    case InstructionSet::avx2:
      if (__builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma")) return &kAvx2Kernels;
      break;
    case InstructionSet::avx512:
      if (__builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq") &&
          __builtin_cpu_supports("avx512vl")) {
        return &kAvx512Kernels;
      }
      break;
#else
    case InstructionSet::avx2:
    case InstructionSet::avx512:
      break;
#endif
  }
  return nullptr;
}

}  // namespace

const KernelTable& kernels_for(InstructionSet set) {
  if (set == InstructionSet::automatic) set = available_instruction_sets().front();
  const KernelTable* kernels = find_kernels(set);
  if (kernels == nullptr) {
    throw SolverError("this processor or this build lacks the instruction set " +
                      std::string(instruction_set_name(set)) + "; choose automatic");
  }
  return *kernels;
}

}  // namespace cholesky

std::string_view instruction_set_name(InstructionSet set) {
  switch (set) {
    case InstructionSet::avx512:
      return "AVX-512";
    case InstructionSet::avx2:
      return "AVX2";
    case InstructionSet::baseline:
      return "baseline";
    case InstructionSet::automatic:
      break;
  }
  return "automatic";
}

std::vector<InstructionSet> available_instruction_sets() {
  std::vector<InstructionSet> sets;
  for (const InstructionSet set :
       {InstructionSet::avx512, InstructionSet::avx2, InstructionSet::baseline}) {
    if (cholesky::find_kernels(set) != nullptr) sets.push_back(set);
  }
  return sets;
}

}  // namespace lapwing
