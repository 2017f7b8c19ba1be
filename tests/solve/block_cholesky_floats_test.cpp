// The factor held in floats. What holds for every kernel is tested with those of doubles
// (block_cholesky_test).

#include <cmath>
#include <limits>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "lapwing/mesh/shapes.h"
#include "lapwing/solve/block_cholesky/block_cholesky.h"
#include "lapwing/solve/block_cholesky/denormals.h"
#include "solve/test_matrices.h"

namespace lapwing {
namespace {

using namespace test;
using ::testing::Lt;

BlockCholeskyOptions in_floats() {
  BlockCholeskyOptions options;
  options.precision = FactorPrecision::float32;
  return options;
}

TEST(BlockCholeskyInFloats, IsSharedByAnAnalysisInDoublesAndHoldsHalf) {
  const OwnedMatrix A = rsi_matrix(icosphere(4), 1.0, 10);
  const auto b = random_vector(A.matrix.scalar_size(), 2);
  BlockCholesky doubles;
  const auto expected = solve_with(doubles, A.matrix, b, 1);
  BlockCholesky floats(in_floats());
  floats.analyze_as(doubles.analysis());
  EXPECT_EQ(floats.statistics().flops, doubles.statistics().flops);
  const double share = static_cast<double>(floats.statistics().factor_bytes) /
                       static_cast<double>(doubles.statistics().factor_bytes);
  EXPECT_NEAR(share, 0.5, 0.1);
  EXPECT_LT(floats.statistics().peak_bytes, doubles.statistics().peak_bytes);
  floats.factorize(A.matrix);
  std::vector<double> x(b.size());
  floats.solve(b, x, 1);
  EXPECT_NE(x, expected);
  EXPECT_THAT(backward_error(A.matrix, x, b), Lt(kBackwardErrorOfFloats));
}

// Far beyond what floats themselves hold.
TEST(BlockCholeskyInFloats, SolvesForRightHandSidesOfAnySize) {
  const OwnedMatrix A = laplacian_matrix(icosphere(3), 1.0, 10);
  const std::size_t n = A.matrix.scalar_size();
  const auto b = random_vector(2 * n, 2);
  BlockCholesky solver(in_floats());
  const auto x = solve_with(solver, A.matrix, b, 2);
  for (const int exponent : {-900, -200, 200, 900, 1020}) {
    SCOPED_TRACE(exponent);
    auto scaled = b;
    for (std::size_t i = 0; i < n; ++i) scaled[i] = std::ldexp(b[i], exponent);
    solver.solve(scaled, scaled, 2);
    for (std::size_t i = 0; i < n; ++i) ASSERT_EQ(scaled[i], std::ldexp(x[i], exponent));
    EXPECT_TRUE(std::equal(x.begin() + static_cast<std::ptrdiff_t>(n), x.end(),
                           scaled.begin() + static_cast<std::ptrdiff_t>(n)));
  }
  std::vector<double> zero(n, 0.0);
  solver.solve(zero, zero, 1);
  EXPECT_EQ(zero, std::vector<double>(n, 0.0));
}

TEST(BlockCholeskyInFloats, RefusesWhatOnlyDoublesCanTell) {
  const OwnedMatrix A = laplacian_matrix(icosphere(3), 1e-9, 40);
  const auto b = random_vector(A.matrix.scalar_size(), 2);
  BlockCholesky floats(in_floats());
  EXPECT_THROW(solve_with(floats, A.matrix, b), NotPositiveDefinite);
  BlockCholesky doubles;
  EXPECT_THAT(backward_error(A.matrix, solve_with(doubles, A.matrix, b), b), Lt(kBackwardError));
}

TEST(BlockCholeskyInFloats, RefusesWhatFloatsDoNotHold) {
  OwnedMatrix A = laplacian_matrix(icosphere(1), 1.0, 5);
  for (double& value : A.matrix.values) value *= 1e40;
  BlockCholesky solver(in_floats());
  EXPECT_THROW(solve_with(solver, A.matrix, random_vector(A.matrix.scalar_size(), 1)),
               NotPositiveDefinite);
}

TEST(BlockCholeskyInFloats, RefactorsToTheSameBits) {
  OwnedMatrix A = rsi_matrix(icosphere(4), 1.0, 10);
  const auto b = random_vector(A.matrix.scalar_size(), 2);
  BlockCholesky solver(in_floats());
  solve_with(solver, A.matrix, b);
  add_to_diagonal(A.matrix, 17, 2.0);
  const std::vector<Index> changed{17};
  solver.refactorize_diagonal(A.matrix, changed);
  std::vector<double> x(b.size());
  solver.solve(b, x, 1);
  BlockCholesky anew(in_floats());
  EXPECT_EQ(x, solve_with(anew, A.matrix, b));
}

// A product that compilers leave to the processor.
float product(float a, float b) {
  volatile float factor = a;
  return factor * b;
}

TEST(Denormals, AreZeroInFloatsForAsLongAsThatIsWanted) {
  const float least = std::numeric_limits<float>::min();
  EXPECT_GT(product(least, 0.25F), 0.0F);
  {
    [[maybe_unused]] const cholesky::DenormalsFor<float> flushed;
    EXPECT_EQ(product(least, 0.25F), 0.0F);
    EXPECT_EQ(product(std::numeric_limits<float>::denorm_min(), 1e30F), 0.0F);
    EXPECT_EQ(product(least, 4.0F), 4.0F * least);
  }
  EXPECT_GT(product(least, 0.25F), 0.0F);
}

TEST(Denormals, AreKeptInDoubles) {
  [[maybe_unused]] const cholesky::DenormalsFor<double> kept;
  volatile double factor = std::numeric_limits<double>::min();
  EXPECT_GT(factor * 0.25, 0.0);
}

}  // namespace
}  // namespace lapwing
