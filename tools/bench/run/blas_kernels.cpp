#include "run/blas_kernels.h"

#include <cstdlib>
#include <dlfcn.h>
#include <string_view>
#include <unistd.h>

#include "lapwing/base/instruction_set.h"

namespace lapwing::bench {
namespace {

constexpr const char* kChosenKernels = "OPENBLAS_CORETYPE";
// OpenBLAS's choice for an unknown x86-64 processor.
constexpr std::string_view kKernelsForUnknown = "Prescott";

// Returns an empty name if the program has another BLAS or none.
std::string_view kernels_of_blas() {
  using CoreName = char* (*)();
  const auto name = reinterpret_cast<CoreName>(dlsym(RTLD_DEFAULT, "openblas_get_corename"));
  return name != nullptr ? name() : "";
}

}  // namespace

void require_fitting_blas(char** arguments) {
  if (std::getenv(kChosenKernels) != nullptr || kernels_of_blas() != kKernelsForUnknown) return;
  const InstructionSet best = available_instruction_sets().front();
  if (best == InstructionSet::baseline) return;
  setenv(kChosenKernels, best == InstructionSet::avx512 ? "SkylakeX" : "Haswell", 1);
  execv("/proc/self/exe", arguments);  // if this fails, the program goes on unchanged
}

}  // namespace lapwing::bench
