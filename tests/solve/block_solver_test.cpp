// Tests the contract of BlockSolver for every factorization.

#include "lapwing/solve/block_solver.h"

#include <algorithm>
#include <numeric>
#include <random>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "lapwing/mesh/shapes.h"
#include "lapwing/solve/ordering.h"
#include "solve/test_matrices.h"
#include "solvers/peer_solvers.h"

namespace lapwing {
namespace {

using namespace test;
using ::testing::Lt;

struct NamedSolver {
  const char* name;
  std::unique_ptr<BlockSolver> (*make)();
};

class EveryBlockSolver : public ::testing::TestWithParam<NamedSolver> {
 protected:
  std::unique_ptr<BlockSolver> solver_ = GetParam().make();
};

TEST_P(EveryBlockSolver, SolvesOneAndSeveralRightHandSides) {
  for (const OwnedMatrix& A : {laplacian_matrix(torus(20, 10, 2.0, 0.5), 1.0, 10),
                               rsi_matrix(torus(20, 10, 2.0, 0.5), 1.0, 10),
                               random_matrix(60, 3, 4.0, 0.1, 1), dense_matrix(1, 1, 1)}) {
    for (const std::size_t columns : {1, 12}) {
      const auto b = random_vector(columns * A.matrix.scalar_size(), 2);
      const auto x = solve_with(*solver_, A.matrix, b, columns);
      EXPECT_THAT(backward_error(A.matrix, x, b, columns), Lt(kBackwardError));
    }
  }
}

TEST_P(EveryBlockSolver, SolvesInPlace) {
  const OwnedMatrix A = rsi_matrix(icosphere(1), 1.0, 5);
  const auto b = random_vector(A.matrix.scalar_size(), 2);
  const auto x = solve_with(*solver_, A.matrix, b);
  auto y = b;
  solver_->solve(y, y, 1);
  EXPECT_EQ(x, y);
}

TEST_P(EveryBlockSolver, SharesItsAnalysisOrSaysThatItCannot) {
  const OwnedMatrix A = rsi_matrix(icosphere(1), 1.0, 5);
  const auto b = random_vector(A.matrix.scalar_size(), 2);
  const auto x = solve_with(*solver_, A.matrix, b);
  const auto other = GetParam().make();
  if (solver_->analysis() == nullptr) {
    EXPECT_THROW(other->analyze_as(nullptr), SolverError);
    return;
  }
  other->analyze_as(solver_->analysis());
  other->factorize(A.matrix);
  std::vector<double> y(b.size());
  other->solve(b, y, 1);
  EXPECT_EQ(x, y);
}

TEST_P(EveryBlockSolver, SolvesInTheOrderOfTheCaller) {
  constexpr std::size_t kColumns = 3;
  for (const OwnedMatrix& A :
       {laplacian_matrix(icosphere(2), 1.0, 5), rsi_matrix(icosphere(1), 1.0, 5)}) {
    const std::size_t n = A.matrix.scalar_size();
    const auto block_size = static_cast<std::size_t>(A.matrix.block_size);
    const auto b = random_vector(kColumns * n, 2);
    const auto x = solve_with(*solver_, A.matrix, b, kColumns);
    std::vector<Index> places(n / block_size);
    std::iota(places.begin(), places.end(), 0U);
    std::shuffle(places.begin(), places.end(), std::mt19937(3));
    const auto placed = [&](const std::vector<double>& numbers) {
      std::vector<double> result(numbers.size());
      for (std::size_t i = 0; i < numbers.size(); ++i) {
        const std::size_t row = i % n;
        result[i - row + block_size * places[row / block_size] + row % block_size] = numbers[i];
      }
      return result;
    };
    auto y = placed(b);
    solver_->solve_in_places(y, kColumns, places);
    EXPECT_EQ(y, placed(x));
  }
}

TEST_P(EveryBlockSolver, FactorsOtherValuesWithTheSameAnalysis) {
  OwnedMatrix A = rsi_matrix(icosphere(1), 1.0, 5);
  const auto b = random_vector(A.matrix.scalar_size(), 2);
  solve_with(*solver_, A.matrix, b);
  for (double& value : A.matrix.values) value *= 2.0;
  solver_->factorize(A.matrix);
  std::vector<double> x(b.size());
  solver_->solve(b, x, 1);
  EXPECT_THAT(backward_error(A.matrix, x, b), Lt(kBackwardError));
}

TEST_P(EveryBlockSolver, RefactorsChangedDiagonalBlocks) {
  OwnedMatrix A = rsi_matrix(icosphere(2), 1.0, 5);
  const auto b = random_vector(A.matrix.scalar_size(), 2);
  solve_with(*solver_, A.matrix, b);
  const std::vector<Index> changed{3, 77};
  for (const Index block : changed) add_to_diagonal(A.matrix, block, 2.0);
  solver_->refactorize_diagonal(A.matrix, changed);
  std::vector<double> x(b.size());
  solver_->solve(b, x, 1);
  EXPECT_THAT(backward_error(A.matrix, x, b), Lt(kBackwardError));
}

TEST_P(EveryBlockSolver, RefusesAnIndefiniteMatrixAndNamesTheBlock) {
  MatrixBuilder builder(4, 1);
  for (std::size_t i = 0; i < 4; ++i) builder.add(i, i, i == 2 ? -1.0 : 1.0);
  const OwnedMatrix A = builder.build();
  try {
    solve_with(*solver_, A.matrix, random_vector(4, 1));
    FAIL() << "an indefinite matrix was factored";
  } catch (const NotPositiveDefinite& error) {
    EXPECT_EQ(error.block, 2U);
  }
}

INSTANTIATE_TEST_SUITE_P(Each, EveryBlockSolver,
                         ::testing::Values(
#ifdef LAPWING_HAVE_CHOLMOD
                             NamedSolver{"Cholmod", bench::make_cholmod_solver},
#endif
                             NamedSolver{"Block", [] { return make_solver(); }},
                             NamedSolver{"Eigen", bench::make_eigen_solver}),
                         [](const auto& suite) { return suite.param.name; });

// Compares block Cholesky with Eigen on 300 random systems.
TEST(BlockSolvers, AgreeOnRandomSystems) {
  const auto ours = make_solver();
  const auto reference = bench::make_eigen_solver();
  std::mt19937 random(11);
  for (unsigned trial = 0; trial < 300; ++trial) {
    const std::size_t blocks = 1 + random() % (trial % 10 == 0 ? 800 : 80);
    const int block_size = random() % 2 == 0 ? 1 : 3;
    const double degree = static_cast<double>(random() % 60) / 10.0;
    OwnedMatrix A = random_matrix(blocks, block_size, degree, 0.05, trial);
    if (trial % 3 == 0) scale_badly(A.matrix, 5.0, trial);
    const auto b = random_vector(A.matrix.scalar_size(), trial);
    const auto x = solve_with(*ours, A.matrix, b);
    const auto y = solve_with(*reference, A.matrix, b);
    SCOPED_TRACE("trial " + std::to_string(trial));
    EXPECT_THAT(backward_error(A.matrix, x, b), Lt(kBackwardError));
    EXPECT_THAT(backward_error(A.matrix, y, b), Lt(kBackwardError));
    for (std::size_t i = 0; i < x.size(); ++i) ASSERT_NEAR(x[i], y[i], 1e-9 * std::abs(y[i]));
  }
}

}  // namespace
}  // namespace lapwing
