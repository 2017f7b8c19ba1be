#include "lapwing/settle/anderson_loops.h"

namespace lapwing {
namespace {

#include "lapwing/settle/anderson_loops.inl"

}  // namespace

extern const AndersonLoops kAndersonLoopsBaseline;
const AndersonLoops kAndersonLoopsBaseline = {multiply, subtract};

}  // namespace lapwing
