#include "lapwing/settle/anderson_loops.h"

namespace lapwing {
namespace {

#include "lapwing/settle/anderson_loops.inl"

}  // namespace

extern const AndersonLoops kAndersonLoopsAvx2;
const AndersonLoops kAndersonLoopsAvx2 = {multiply, subtract};

}  // namespace lapwing
