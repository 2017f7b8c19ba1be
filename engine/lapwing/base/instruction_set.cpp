#include "lapwing/base/instruction_set.h"

#include <cstdlib>

namespace lapwing {

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

namespace {

// Other values have no effect.
InstructionSet best_allowed() {
  const char* const value = std::getenv("LAPWING_INSTRUCTION_SET");
  const std::string_view name = value != nullptr ? value : "";
  if (name == "baseline") return InstructionSet::baseline;
  if (name == "avx2") return InstructionSet::avx2;
  return InstructionSet::avx512;
}

std::vector<InstructionSet> sets_of_processor() {
  std::vector<InstructionSet> sets;
#if defined(__x86_64__)
  if (__builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq") &&
      __builtin_cpu_supports("avx512vl")) {
    sets.push_back(InstructionSet::avx512);
  }
  if (__builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma")) {
    sets.push_back(InstructionSet::avx2);
  }
#endif
  sets.push_back(InstructionSet::baseline);
  std::erase_if(sets, [best = best_allowed()](InstructionSet set) { return set > best; });
  return sets;
}

}  // namespace

std::vector<InstructionSet> available_instruction_sets() {
  static const std::vector<InstructionSet> sets = sets_of_processor();
  return sets;
}

}  // namespace lapwing
