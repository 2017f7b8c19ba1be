#include "lapwing/elastic/history_loops.h"

namespace lapwing {
namespace {

constexpr std::size_t kLanes = 4;  // numbers of a register

#include "lapwing/elastic/history_loops.inl"

}  // namespace

extern const HistoryLoops kHistoryLoopsAvx2;
const HistoryLoops kHistoryLoopsAvx2 = {multiply, subtract, dot};

}  // namespace lapwing
