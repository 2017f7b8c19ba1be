#pragma once

#include <string_view>
#include <vector>

namespace lapwing {

/// Vector instruction sets. Inner loops are compiled once for each instruction set.
enum class InstructionSet {
  automatic,  ///< the best that this processor supports
  baseline,   ///< SSE2 on x86-64, NEON on 64-bit ARM
  avx2,       ///< includes FMA, which rounds differently
  avx512,     ///< F, DQ and VL; includes FMA
};
std::string_view instruction_set_name(InstructionSet set);

/// Returns the instruction sets that this processor and this build support, best first; `baseline`
/// is always the last. If the environment variable LAPWING_INSTRUCTION_SET is "baseline", "avx2" or
/// "avx512", better instruction sets are omitted, so that results are the same as on a processor
/// without them. The variable is read once.
std::vector<InstructionSet> available_instruction_sets();

}  // namespace lapwing
