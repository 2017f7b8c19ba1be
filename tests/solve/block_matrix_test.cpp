#include "lapwing/solve/block_matrix.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "lapwing/solve/ordering.h"
#include "solve/test_matrices.h"
#include "solvers/scalar_lower.h"

namespace lapwing {
namespace {

using namespace test;
using namespace bench;
using ::testing::ElementsAre;

// The whole matrix, from its entries one by one.
Eigen::MatrixXd dense(const BlockMatrix& A) {
  const auto b = static_cast<std::size_t>(A.block_size);
  const auto n = static_cast<Eigen::Index>(A.scalar_size());
  Eigen::MatrixXd D = Eigen::MatrixXd::Zero(n, n);
  for (std::size_t c = 0; c < A.pattern->size(); ++c) {
    for (std::size_t e = A.pattern->starts[c]; e < A.pattern->starts[c + 1]; ++e) {
      for (std::size_t k = 0; k < b * b; ++k) {
        const auto row = static_cast<Eigen::Index>(A.pattern->rows[e] * b + k % b);
        const auto column = static_cast<Eigen::Index>(c * b + k / b);
        D(row, column) = D(column, row) = A.block(e)[k];
      }
    }
  }
  return D;
}

TEST(BlockMatrix, MultipliesLikeTheDenseMatrix) {
  for (const int block_size : {1, 3}) {
    const OwnedMatrix A = random_matrix(20, block_size, 4.0, 0.1, 2);
    const auto n = static_cast<Eigen::Index>(A.matrix.scalar_size());
    const auto x = random_vector(2 * A.matrix.scalar_size(), 3);
    std::vector<double> y(x.size(), 7.0);
    multiply(A.matrix, x, y, 2);
    const Eigen::Map<const Eigen::MatrixXd> X(x.data(), n, 2);
    const Eigen::Map<const Eigen::MatrixXd> Y(y.data(), n, 2);
    EXPECT_TRUE(Y.isApprox(dense(A.matrix) * X, 1e-14));
  }
}

TEST(BlockMatrix, GraphHasBothTrianglesAscendingWithoutDiagonal) {
  MatrixBuilder builder(4, 1);
  builder.add(2, 0, 1.0);
  builder.add(3, 2, 1.0);
  const OwnedMatrix A = builder.build();
  const BlockGraph graph = block_graph(*A.pattern);
  EXPECT_THAT(graph.starts, ElementsAre(0, 1, 1, 3, 4));
  EXPECT_THAT(graph.neighbours, ElementsAre(2, 0, 3, 2));
}

TEST(BlockMatrix, GraphOfTheEmptyPatternIsEmpty) {
  EXPECT_THAT(block_graph(BlockPattern{}).starts, ElementsAre(0));
}

TEST(ScalarLower, HoldsTheLowerTriangle) {
  for (const int block_size : {1, 3}) {
    const OwnedMatrix A = random_matrix(15, block_size, 3.0, 0.1, 4);
    ScalarLower lower = scalar_lower_pattern(*A.pattern, block_size);
    fill_scalar_lower(A.matrix, lower);
    const Eigen::MatrixXd expected = dense(A.matrix).triangularView<Eigen::Lower>();
    EXPECT_EQ(Eigen::MatrixXd(lower), expected);
  }
}

TEST(ScalarLower, HasAscendingRowsInEachColumn) {
  const OwnedMatrix A = random_matrix(15, 3, 3.0, 0.1, 4);
  const ScalarLower lower = scalar_lower_pattern(*A.pattern, 3);
  for (int c = 0; c < lower.outerSize(); ++c) {
    const int* begin = lower.innerIndexPtr() + lower.outerIndexPtr()[c];
    const int* end = lower.innerIndexPtr() + lower.outerIndexPtr()[c + 1];
    EXPECT_EQ(*begin, c);
    EXPECT_EQ(std::adjacent_find(begin, end, std::greater_equal<>()), end);
  }
}

TEST(ScalarLower, OrderKeepsTheRowsOfABlockTogether) {
  EXPECT_THAT(scalar_order(std::vector{2, 0, 1}, 3), ElementsAre(6, 7, 8, 0, 1, 2, 3, 4, 5));
  EXPECT_THAT(scalar_order(std::vector{2, 0, 1}, 1), ElementsAre(2, 0, 1));
}

}  // namespace
}  // namespace lapwing
