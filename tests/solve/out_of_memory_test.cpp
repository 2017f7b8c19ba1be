#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "lapwing/mesh/shapes.h"
#include "lapwing/solve/block_cholesky/arena.h"
#include "lapwing/solve/block_cholesky/block_cholesky.h"
#include "lapwing/solve/ordering.h"
#include "solve/test_matrices.h"
#include "support/failing_new.h"

namespace lapwing {
namespace {

using namespace test;
using ::testing::HasSubstr;

TEST(OutOfMemory, IsASolverErrorWhereverItHappensAndLeavesTheSolverUsable) {
  const OwnedMatrix A = rsi_matrix(icosphere(3), 1.0, 40);
  const auto b = random_vector(2 * A.matrix.scalar_size(), 1);
  const auto order = fill_reducing_order(*A.pattern);
  BlockCholeskyOptions options;
  options.threads = 2;
  std::vector<double> expected(b.size());
  const auto run = [&](BlockCholesky& solver, std::vector<double>& x) {
    solver.analyze(*A.pattern, 3, order);
    solver.factorize(A.matrix);
    solver.solve(b, x, 2);
  };
  long calls = 0;
  {
    BlockCholesky solver(options);
    cholesky::free_spare_memory();  // what is spare is not asked for
    const FailingNew counter(-1);
    run(solver, expected);
    calls = FailingNew::calls();
  }
  ASSERT_GT(calls, 50);
  for (long k = 0; k < 50; ++k) {
    // Half of them anywhere, half among the last, which are the numeric memory.
    const long fail_at = k % 2 == 0 ? calls * k / 50 : calls - 1 - k / 2;
    SCOPED_TRACE("call " + std::to_string(fail_at) + " of " + std::to_string(calls));
    BlockCholesky solver(options);
    std::vector<double> x(b.size());
    cholesky::free_spare_memory();
    try {
      const FailingNew failure(fail_at);
      run(solver, x);
      ADD_FAILURE() << "nothing failed";
    } catch (const SolverError& error) {
      EXPECT_THAT(error.what(), HasSubstr("out of memory"));
    }
    run(solver, x);
    EXPECT_EQ(x, expected);
  }
}

TEST(OutOfMemory, SaysHowMuchTheFactorizationNeeds) {
  const OwnedMatrix A = rsi_matrix(icosphere(1), 1.0, 10);
  BlockCholesky solver;
  solver.analyze(*A.pattern, 3, fill_reducing_order(*A.pattern));
  try {
    const FailingNew failure(1);
    solver.factorize(A.matrix);
    FAIL() << "nothing failed";
  } catch (const SolverError& error) {
    EXPECT_THAT(error.what(), HasSubstr(" MB"));
  }
}

}  // namespace
}  // namespace lapwing
