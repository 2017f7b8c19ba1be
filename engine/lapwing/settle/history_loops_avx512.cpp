#include "lapwing/settle/history_loops.h"

namespace lapwing {
namespace {

#include "lapwing/settle/history_loops.inl"

}  // namespace

extern const HistoryLoops kHistoryLoopsAvx512;
const HistoryLoops kHistoryLoopsAvx512 = {multiply, subtract, dot};

}  // namespace lapwing
