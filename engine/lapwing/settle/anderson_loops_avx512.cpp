#include "lapwing/settle/anderson_loops.h"

namespace lapwing {
namespace {

#include "lapwing/settle/anderson_loops.inl"

}  // namespace

extern const AndersonLoops kAndersonLoopsAvx512;
const AndersonLoops kAndersonLoopsAvx512 = {multiply, subtract};

}  // namespace lapwing
