#pragma once

#include <string_view>
#include <vector>

namespace lapwing {

/// Vector instructions of the processor, for inner loops that are compiled once for each.
enum class InstructionSet {
  automatic,  ///< the best this processor has
  baseline,   ///< what every processor of the target has: SSE2 on x86-64, NEON on 64-bit ARM
  avx2,       ///< with FMA
  avx512,     ///< F, DQ, VL
};
std::string_view instruction_set_name(InstructionSet set);

/// Those that this processor and this build have, best first; `baseline` is always the last.
std::vector<InstructionSet> available_instruction_sets();

}  // namespace lapwing
