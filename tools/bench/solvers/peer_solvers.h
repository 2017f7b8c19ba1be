#pragma once

#include <memory>

#include "lapwing/solve/block_solver.h"

namespace lapwing::bench {

/// Eigen's simplicial Cholesky, to compare with.
std::unique_ptr<BlockSolver> make_eigen_solver();

#ifdef LAPWING_HAVE_CHOLMOD
/// Returns a solver that uses CHOLMOD's supernodal Cholesky factorization. The caller supplies the
/// elimination order of the blocks.
std::unique_ptr<BlockSolver> make_cholmod_solver();
#endif

}  // namespace lapwing::bench
