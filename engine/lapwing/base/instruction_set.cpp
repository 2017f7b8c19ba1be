#include "lapwing/base/instruction_set.h"

#include <array>
#include <cstdlib>

namespace lapwing {

std::string_view instruction_set_name(InstructionSet set) {
  constexpr std::array<std::string_view, 4> kNames{"automatic", "baseline", "AVX2", "AVX-512"};
  return kNames[static_cast<std::size_t>(set)];
}

namespace {

// Returns the best set that LAPWING_INSTRUCTION_SET allows; invalid values have no effect.
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
