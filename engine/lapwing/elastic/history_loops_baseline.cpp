#include "lapwing/elastic/history_loops.h"

namespace lapwing {
namespace {

constexpr std::size_t kLanes = 2;  // numbers of a register

#include "lapwing/elastic/history_loops.inl"

}  // namespace

extern const HistoryLoops kHistoryLoopsBaseline;
const HistoryLoops kHistoryLoopsBaseline = {multiply, subtract, dot};

}  // namespace lapwing
