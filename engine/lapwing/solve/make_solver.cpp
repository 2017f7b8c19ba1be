#include "lapwing/solve/solvers.h"

namespace lapwing {

std::unique_ptr<BlockSolver> make_solver(SolverKind kind) {
#ifdef LAPWING_HAVE_CHOLMOD
  if (kind != SolverKind::eigen) return make_cholmod_solver();
#else
  if (kind == SolverKind::cholmod) {
    throw SolverError(
        "this build has no CHOLMOD (it is under the GPL); configure with -DLAPWING_COPYLEFT=ON or "
        "choose another solver");
  }
#endif
  return make_eigen_solver();
}

}  // namespace lapwing
