#include "lapwing/solve/solvers.h"

namespace lapwing {

std::unique_ptr<BlockSolver> make_solver(SolverKind kind) {
  switch (kind) {
    case SolverKind::automatic:
    case SolverKind::block:
      return make_block_cholesky_solver();
    case SolverKind::eigen:
      return make_eigen_solver();
    case SolverKind::cholmod:
      break;
  }
#ifdef LAPWING_HAVE_CHOLMOD
  return make_cholmod_solver();
#else
  throw SolverError(
      "this build has no CHOLMOD (it is under the GPL); configure with -DLAPWING_COPYLEFT=ON or "
      "choose another solver");
#endif
}

}  // namespace lapwing
