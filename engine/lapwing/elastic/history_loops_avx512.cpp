#include "lapwing/elastic/history_loops.h"

namespace lapwing {
namespace {

constexpr std::size_t kLanes = 8;  // numbers of a register

#include "lapwing/elastic/history_loops.inl"

}  // namespace

extern const HistoryLoops kHistoryLoopsAvx512;
const HistoryLoops kHistoryLoopsAvx512 = {multiply, subtract, dot};

}  // namespace lapwing
