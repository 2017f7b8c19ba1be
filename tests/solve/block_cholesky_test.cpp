#include "lapwing/solve/block_cholesky/block_cholesky.h"

#include <cmath>
#include <limits>
#include <numeric>
#include <tuple>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "lapwing/base/cancellation.h"
#include "lapwing/mesh/shapes.h"
#include "lapwing/solve/ordering.h"
#include "solve/test_matrices.h"

namespace lapwing {
namespace {

using namespace test;
using ::testing::HasSubstr;
using ::testing::Lt;

BlockCholeskyOptions with(unsigned threads, InstructionSet set = InstructionSet::automatic) {
  BlockCholeskyOptions options;
  options.threads = threads;
  options.instruction_set = set;
  return options;
}

// ---- Every instruction set with every number of threads, in either precision.

using KernelChoice = std::tuple<InstructionSet, unsigned, FactorPrecision>;

class BlockCholeskyKernels : public ::testing::TestWithParam<KernelChoice> {
 protected:
  static BlockCholeskyOptions options() {
    BlockCholeskyOptions options = with(std::get<1>(GetParam()), std::get<0>(GetParam()));
    options.precision = std::get<2>(GetParam());
    return options;
  }
  BlockCholesky solver_{options()};

  void expect_solves(const BlockMatrix& A, std::size_t columns) {
    const auto b = random_vector(A.scalar_size() * columns, 5);
    const auto x = solve_with(solver_, A, b, columns);
    const bool in_floats = options().precision == FactorPrecision::float32;
    EXPECT_THAT(backward_error(A, x, b, columns),
                Lt(in_floats ? kBackwardErrorOfFloats : kBackwardError));
  }
};

TEST_P(BlockCholeskyKernels, SolveRandomMatrices) {
  unsigned seed = 0;
  for (const std::size_t blocks : {1, 2, 3, 7, 8, 9, 24, 50, 101, 333}) {
    for (const int block_size : {1, 3}) {
      for (const double degree : {0.5, 2.0, 6.0}) {
        SCOPED_TRACE("blocks " + std::to_string(blocks) + " of size " + std::to_string(block_size) +
                     ", degree " + std::to_string(degree));
        expect_solves(random_matrix(blocks, block_size, degree, 0.1, ++seed).matrix, 1);
      }
    }
  }
}

TEST_P(BlockCholeskyKernels, SolveDenseMatricesOfEverySize) {
  for (std::size_t blocks = 1; blocks <= 34; ++blocks) {
    SCOPED_TRACE(blocks);
    for (const int block_size : {1, 3}) {
      OwnedMatrix A = dense_matrix(blocks, block_size, 7);
      // Floats would refuse the pivots of the worst conditioned ones.
      for (Index b = 0; b < blocks; ++b) add_to_diagonal(A.matrix, b, 0.1);
      expect_solves(A.matrix, 1);
    }
  }
}

TEST_P(BlockCholeskyKernels, SolveTheRsiSystemOfAMesh) {
  expect_solves(rsi_matrix(icosphere(4), 1.0, 100).matrix, 1);
}

TEST_P(BlockCholeskyKernels, SolveAnyNumberOfRightHandSides) {
  const OwnedMatrix A = laplacian_matrix(torus(30, 12, 2.0, 0.6), 1.0, 20);
  const OwnedMatrix B = rsi_matrix(cylinder(9, 14, 0.5, 2.0), 1.0, 20);
  for (std::size_t columns = 1; columns <= 26; ++columns) {
    SCOPED_TRACE(columns);
    expect_solves(A.matrix, columns);
    expect_solves(B.matrix, columns);
  }
}

std::vector<KernelChoice> all_kernels() {
  std::vector<KernelChoice> all;
  for (const InstructionSet set : available_instruction_sets()) {
    for (const unsigned threads : {1U, 2U, 4U}) {
      all.emplace_back(set, threads, FactorPrecision::float64);
      all.emplace_back(set, threads, FactorPrecision::float32);
    }
  }
  return all;
}

INSTANTIATE_TEST_SUITE_P(Each, BlockCholeskyKernels, ::testing::ValuesIn(all_kernels()),
                         [](const auto& suite) {
                           std::string name(instruction_set_name(std::get<0>(suite.param)));
                           std::erase(name, '-');
                           name += "Threads" + std::to_string(std::get<1>(suite.param));
                           const bool in_floats =
                               std::get<2>(suite.param) == FactorPrecision::float32;
                           return name + (in_floats ? "InFloats" : "");
                         });

// ---- Unusual patterns.

TEST(BlockCholesky, SolvesTheEmptySystem) {
  const OwnedMatrix A = MatrixBuilder(0, 3).build();
  BlockCholesky solver;
  EXPECT_TRUE(solve_with(solver, A.matrix, {}).empty());
}

TEST(BlockCholesky, SolvesIsolatedBlocksAndSeveralComponents) {
  for (const int block_size : {1, 3}) {
    const OwnedMatrix A = random_matrix(5000, block_size, 0.8, 0.1, 3);
    const auto b = random_vector(A.matrix.scalar_size(), 4);
    BlockCholesky solver;
    EXPECT_THAT(backward_error(A.matrix, solve_with(solver, A.matrix, b), b), Lt(kBackwardError));
  }
}

// An arrow: one block that touches all others, in front and behind.
TEST(BlockCholesky, SolvesAMatrixWithADenseRow) {
  for (const std::size_t hub : {0, 150, 299}) {
    MatrixBuilder builder(300, 3);
    for (std::size_t i = 0; i < 900; ++i) builder.add(i, i, i / 3 == hub ? 1000.0 : 2.0);
    for (std::size_t i = 0; i < 900; ++i) {
      if (i / 3 == hub) continue;
      builder.add(i, 3 * hub + i % 3, 0.5);
      builder.add(3 * hub + i % 3, i, 0.5);
    }
    const OwnedMatrix A = builder.build();
    const auto b = random_vector(900, 6);
    BlockCholesky solver;
    EXPECT_THAT(backward_error(A.matrix, solve_with(solver, A.matrix, b), b), Lt(kBackwardError));
  }
}

TEST(BlockCholesky, SolvesUnderAnyOrder) {
  const OwnedMatrix A = rsi_matrix(icosphere(2), 1.0, 10);
  const auto b = random_vector(A.matrix.scalar_size(), 8);
  std::vector<int> order(A.pattern->size());
  std::iota(order.begin(), order.end(), 0);
  std::mt19937 random(1);
  for (int trial = 0; trial < 5; ++trial) {
    BlockCholesky solver(with(2));
    solver.analyze(*A.pattern, 3, order);
    solver.factorize(A.matrix);
    std::vector<double> x(b.size());
    solver.solve(b, x, 1);
    EXPECT_THAT(backward_error(A.matrix, x, b), Lt(kBackwardError));
    std::shuffle(order.begin(), order.end(), random);
  }
}

// ---- Conditioning and refusal.

TEST(BlockCholesky, AcceptsConditionNumbersUpToTenToTheTwelve) {
  const Mesh mesh = icosphere(3);
  for (const double weight : {1.0, 1e-3, 1e-6, 1e-9}) {
    for (const OwnedMatrix& A :
         {laplacian_matrix(mesh, weight, 40), rsi_matrix(mesh, weight, 40)}) {
      SCOPED_TRACE("weight " + std::to_string(weight));
      const auto b = random_vector(A.matrix.scalar_size(), 9);
      BlockCholesky solver(with(2));
      EXPECT_THAT(backward_error(A.matrix, solve_with(solver, A.matrix, b), b), Lt(kBackwardError));
    }
  }
}

TEST(BlockCholesky, AcceptsBadlyScaledMatrices) {
  OwnedMatrix A = rsi_matrix(icosphere(3), 1.0, 10);
  scale_badly(A.matrix, 8.0, 2);
  const auto b = random_vector(A.matrix.scalar_size(), 9);
  BlockCholesky solver(with(2));
  EXPECT_THAT(backward_error(A.matrix, solve_with(solver, A.matrix, b), b), Lt(kBackwardError));
}

TEST(BlockCholesky, RefusesMeshesWithoutAnchor) {
  for (const Mesh& mesh :
       {icosphere(0), icosphere(1), icosphere(2), icosphere(3), icosphere(4), grid(1, 1),
        grid(5, 7), grid(60, 60), torus(40, 20, 2.0, 0.5), cylinder(8, 30, 0.5, 4.0)}) {
    SCOPED_TRACE(mesh.vertex_count());
    BlockCholesky solver(with(2));
    const OwnedMatrix A = laplacian_matrix(mesh, 0.0, 0);
    EXPECT_THROW(solve_with(solver, A.matrix, random_vector(A.matrix.scalar_size(), 1)),
                 NotPositiveDefinite);
    const OwnedMatrix B = rsi_matrix(mesh, 0.0, 0);
    EXPECT_THROW(solve_with(solver, B.matrix, random_vector(B.matrix.scalar_size(), 1)),
                 NotPositiveDefinite);
  }
}

// Three chains of which the middle one, blocks 5 to 8, is held nowhere.
OwnedMatrix chains_with_a_loose_one() {
  MatrixBuilder builder(12, 1);
  for (const auto& [first, last] : {std::pair(0, 4), std::pair(5, 8), std::pair(9, 11)}) {
    for (int i = first; i < last; ++i) {
      builder.add(i, i, 1.0);
      builder.add(i + 1, i + 1, 1.0);
      builder.add(i, i + 1, -1.0);
      builder.add(i + 1, i, -1.0);
    }
  }
  builder.add(2, 2, 1.0);
  builder.add(11, 11, 1.0);
  return builder.build();
}

TEST(BlockCholesky, NamesTheBlockAndItsComponent) {
  const OwnedMatrix A = chains_with_a_loose_one();
  BlockCholesky solver;
  try {
    solve_with(solver, A.matrix, random_vector(12, 1));
    FAIL() << "a singular matrix was factored";
  } catch (const NotPositiveDefinite& error) {
    EXPECT_GE(error.block, 5U);
    EXPECT_LE(error.block, 8U);
    EXPECT_THAT(error.what(), HasSubstr("block " + std::to_string(error.block)));
    EXPECT_THAT(error.what(), HasSubstr("the component of 4 blocks whose smallest is block 5"));
  }
}

TEST(BlockCholesky, RefusesIndefiniteZeroAndNegativeMatrices) {
  BlockCholesky solver;
  for (const double diagonal : {0.0, -1.0, 0.5}) {
    MatrixBuilder builder(2, 1);
    builder.add(0, 0, 1.0);
    builder.add(1, 1, diagonal);
    builder.add(1, 0, 1.0);
    EXPECT_THROW(solve_with(solver, builder.build().matrix, random_vector(2, 1)),
                 NotPositiveDefinite);
  }
}

TEST(BlockCholesky, NamesTheBlockThatIsNotFinite) {
  for (const double bad :
       {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
    OwnedMatrix A = rsi_matrix(icosphere(2), 1.0, 10);
    const std::size_t entry = A.pattern->starts[70] + 2;
    A.matrix.values[9 * entry + 4] = bad;
    BlockCholesky solver(with(2));
    try {
      solve_with(solver, A.matrix, random_vector(A.matrix.scalar_size(), 1));
      FAIL() << "a matrix that is not finite was factored";
    } catch (const SolverError& error) {
      EXPECT_THAT(error.what(), HasSubstr("block row " + std::to_string(A.pattern->rows[entry]) +
                                          ", block column 70"));
    }
  }
}

TEST(BlockCholesky, RefusesOverflow) {
  OwnedMatrix A = laplacian_matrix(icosphere(1), 1.0, 5);
  for (double& value : A.matrix.values) value *= 1e308;
  BlockCholesky solver;
  EXPECT_THROW(
      {
        const auto x = solve_with(solver, A.matrix, random_vector(A.matrix.scalar_size(), 1));
        if (std::isfinite(x[0])) throw SolverError("no overflow after all");
      },
      SolverError);
}

TEST(BlockCholesky, FactorsAgainAfterARefusal) {
  OwnedMatrix A = chains_with_a_loose_one();
  BlockCholesky solver;
  const auto b = random_vector(12, 1);
  EXPECT_THROW(solve_with(solver, A.matrix, b), NotPositiveDefinite);
  std::vector<double> x(12);
  EXPECT_THROW(solver.solve(b, x, 1), SolverError);
  add_to_diagonal(A.matrix, 6, 1.0);
  solver.factorize(A.matrix);
  solver.solve(b, x, 1);
  EXPECT_THAT(backward_error(A.matrix, x, b), Lt(kBackwardError));
}

// ---- The interface's contract.

TEST(BlockCholesky, RefusesMoreMemoryThanTheLimit) {
  const OwnedMatrix A = laplacian_matrix(grid(40, 40), 1.0, 10);
  const auto order = fill_reducing_order(*A.pattern);
  BlockCholeskyOptions options;
  BlockCholesky unlimited(options);
  unlimited.analyze(*A.pattern, 1, order);
  const std::size_t peak = unlimited.statistics().peak_bytes;
  options.memory_limit_bytes = peak;
  EXPECT_NO_THROW(BlockCholesky(options).analyze(*A.pattern, 1, order));
  options.memory_limit_bytes = peak - 1;
  BlockCholesky limited(options);
  EXPECT_THROW(limited.analyze(*A.pattern, 1, order), SolverError);
  EXPECT_THROW(limited.analyze_as(unlimited.analysis()), SolverError);
  EXPECT_EQ(limited.analysis(), nullptr);
}

TEST(BlockCholesky, RefusesWhatIsNoPermutation) {
  const OwnedMatrix A = chains_with_a_loose_one();
  std::vector<int> order(12);
  std::iota(order.begin(), order.end(), 0);
  BlockCholesky solver;
  order[3] = 4;
  EXPECT_THROW(solver.analyze(*A.pattern, 1, order), SolverError);
  order[3] = 12;
  EXPECT_THROW(solver.analyze(*A.pattern, 1, order), SolverError);
  order.pop_back();
  EXPECT_THROW(solver.analyze(*A.pattern, 1, order), SolverError);
}

TEST(BlockCholesky, CountsTheOperationsOfADenseFactorization) {
  const OwnedMatrix A = dense_matrix(20, 3, 1);
  BlockCholesky solver;
  solver.analyze(*A.pattern, 3, fill_reducing_order(*A.pattern));
  double flops = 0.0;
  for (double k = 1; k <= 60; ++k) flops += k * k;
  EXPECT_DOUBLE_EQ(solver.statistics().flops, flops);
  EXPECT_GE(solver.statistics().factor_bytes, 60U * 61U / 2U * sizeof(double));
}

// ---- An analysis that several solvers share.

TEST(BlockCholesky, FactorsToTheSameBitsByTheAnalysisOfAnother) {
  const OwnedMatrix A = rsi_matrix(icosphere(3), 1.0, 10);
  const auto b = random_vector(A.matrix.scalar_size(), 2);
  auto usual = std::make_unique<BlockCholesky>();
  const auto x = solve_with(*usual, A.matrix, b, 1);
  BlockCholesky sharing;
  sharing.analyze_as(usual->analysis());
  EXPECT_EQ(sharing.statistics().flops, usual->statistics().flops);
  EXPECT_EQ(sharing.statistics().peak_bytes, usual->statistics().peak_bytes);
  usual.reset();
  sharing.factorize(A.matrix);
  std::vector<double> y(b.size());
  sharing.solve(b, y, 1);
  EXPECT_EQ(x, y);
}

TEST(BlockCholesky, RefusesToWorkWithoutAnAnalysis) {
  BlockCholesky solver;
  EXPECT_THROW(solver.prepare_memory(), SolverError);
  EXPECT_EQ(solver.analysis(), nullptr);
  EXPECT_THROW(solver.analyze_as(nullptr), SolverError);
}

// ---- Memory taken ahead.

TEST(BlockCholesky, FactorsToTheSameBitsInMemoryTakenAhead) {
  const OwnedMatrix A = rsi_matrix(icosphere(4), 1.0, 10);
  const auto b = random_vector(A.matrix.scalar_size(), 2);
  BlockCholesky usual;
  BlockCholesky ahead;
  ahead.analyze(*A.pattern, 3, fill_reducing_order(*A.pattern, Ordering::minimum_degree));
  ahead.prepare_memory();
  ahead.prepare_memory();
  ahead.factorize(A.matrix);
  std::vector<double> x(b.size());
  ahead.solve(b, x, 1);
  EXPECT_EQ(x, solve_with(usual, A.matrix, b));
}

TEST(BlockCholesky, CanBeCancelledWhileItTakesMemory) {
  const OwnedMatrix A = laplacian_matrix(grid(150, 150), 1.0, 10);
  BlockCholesky solver;
  solver.analyze(*A.pattern, 1, fill_reducing_order(*A.pattern));
  {
    const AskAtEveryCheck always;
    const ProgressScope scope([](std::string_view, double) { return false; });
    EXPECT_THROW(solver.prepare_memory(), Cancelled);
  }
  EXPECT_NO_THROW(solver.factorize(A.matrix));
}

// ---- Refactoring.

TEST(BlockCholesky, RefactorsChangedDiagonalBlocksToTheSameBits) {
  for (OwnedMatrix& A :
       std::array{rsi_matrix(icosphere(4), 1.0, 10), laplacian_matrix(grid(150, 150), 1.0, 10)}) {
    const auto order = fill_reducing_order(*A.pattern, Ordering::nested_dissection);
    const auto b = random_vector(A.matrix.scalar_size(), 2);
    BlockCholesky partial(with(2));
    partial.analyze(*A.pattern, A.matrix.block_size, order);
    partial.factorize(A.matrix);
    std::mt19937 random(4);
    for (const std::size_t count : {0, 1, 1, 1, 5, 40}) {
      std::vector<Index> changed;
      for (std::size_t k = 0; k < count; ++k) {
        changed.push_back(static_cast<Index>(random() % A.pattern->size()));
        add_to_diagonal(A.matrix, changed.back(), 0.5);
      }
      partial.refactorize_diagonal(A.matrix, changed);
      BlockCholesky full(with(1));
      full.analyze(*A.pattern, A.matrix.block_size, order);
      full.factorize(A.matrix);
      std::vector<double> x(b.size());
      std::vector<double> y(b.size());
      partial.solve(b, x, 1);
      full.solve(b, y, 1);
      EXPECT_EQ(x, y) << count << " blocks changed";
    }
  }
}

}  // namespace
}  // namespace lapwing
