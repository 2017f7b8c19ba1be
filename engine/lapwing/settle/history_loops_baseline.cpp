#include "lapwing/settle/history_loops.h"

namespace lapwing {
namespace {

#include "lapwing/settle/history_loops.inl"

}  // namespace

extern const HistoryLoops kHistoryLoopsBaseline;
const HistoryLoops kHistoryLoopsBaseline = {multiply, subtract, dot};

}  // namespace lapwing
