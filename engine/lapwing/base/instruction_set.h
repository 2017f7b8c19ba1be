#pragma once

#include <string_view>
#include <vector>

namespace lapwing {

/// Vector instructions of the processor, for inner loops that are compiled once for each.
enum class InstructionSet {
  automatic,  ///< the best this processor has
  baseline,   ///< what every processor of the target has: SSE2 on x86-64, NEON on 64-bit ARM
  avx2,       ///< with FMA, which rounds otherwise
  avx512,     ///< F, DQ, VL; so does this
};
std::string_view instruction_set_name(InstructionSet set);

/// Those that this processor and this build have, best first; `baseline` is always the last. Where
/// the environment's LAPWING_INSTRUCTION_SET is "baseline", "avx2" or "avx512", what is better than
/// that is left out: the program then computes as on a processor without. Read once.
std::vector<InstructionSet> available_instruction_sets();

}  // namespace lapwing
