#pragma once

#include <memory>

#include "lapwing/solve/block_solver.h"

namespace lapwing::bench {

/// Eigen's simplicial Cholesky, to compare with.
std::unique_ptr<BlockSolver> make_eigen_solver();

#ifdef LAPWING_HAVE_CHOLMOD
/// CHOLMOD's order: its own of the scalar graph, or the given order of the blocks.
enum class CholmodOrdering { amd, metis, blocks };

/// CHOLMOD's supernodal Cholesky, to compare with.
std::unique_ptr<BlockSolver> make_cholmod_solver();
#endif

}  // namespace lapwing::bench
