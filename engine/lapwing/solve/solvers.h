#pragma once

#include <memory>

#include "lapwing/solve/block_solver.h"

namespace lapwing {

/// One maker per factorization; `make_solver` chooses.
std::unique_ptr<BlockSolver> make_block_cholesky_solver();
std::unique_ptr<BlockSolver> make_eigen_solver();
std::unique_ptr<BlockSolver> make_cholmod_solver();

}  // namespace lapwing
