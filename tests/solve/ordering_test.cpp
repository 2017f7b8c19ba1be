#include "lapwing/solve/ordering.h"

#include <numeric>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "lapwing/mesh/shapes.h"
#include "lapwing/solve/block_solver.h"
#include "solve/test_matrices.h"

namespace lapwing {
namespace {

using namespace test;
using ::testing::Lt;

class EveryOrdering : public ::testing::TestWithParam<Ordering> {};

TEST_P(EveryOrdering, IsAPermutation) {
  for (const OwnedMatrix& A :
       {laplacian_matrix(grid(17, 9), 1.0, 10), random_matrix(40, 1, 0.5, 0.1, 1),
        random_matrix(30, 1, 0.0, 0.1, 1), random_matrix(1, 1, 0.0, 0.1, 1)}) {
    std::vector<int> order = fill_reducing_order(*A.pattern, GetParam());
    std::sort(order.begin(), order.end());
    std::vector<int> all(A.pattern->size());
    std::iota(all.begin(), all.end(), 0);
    EXPECT_EQ(order, all);
  }
}

TEST_P(EveryOrdering, IsTheSameEachTime) {
  const OwnedMatrix A = laplacian_matrix(icosphere(4), 1.0, 10);
  const auto order = fill_reducing_order(*A.pattern, GetParam());
  for (int run = 0; run < 3; ++run) {
    EXPECT_EQ(fill_reducing_order(*A.pattern, GetParam()), order);
  }
}

TEST_P(EveryOrdering, SavesOperations) {
  const OwnedMatrix A = laplacian_matrix(icosphere(4), 1.0, 10);
  std::vector<int> natural(A.pattern->size());
  std::iota(natural.begin(), natural.end(), 0);
  const auto flops = [&](std::span<const int> order) {
    const auto solver = make_solver();
    solver->analyze(*A.pattern, 1, order);
    return solver->statistics().flops;
  };
  EXPECT_THAT(flops(fill_reducing_order(*A.pattern, GetParam())), Lt(0.3 * flops(natural)));
}

INSTANTIATE_TEST_SUITE_P(Each, EveryOrdering,
                         ::testing::Values(Ordering::automatic, Ordering::minimum_degree,
                                           Ordering::nested_dissection),
                         [](const auto& suite) {
                           switch (suite.param) {
                             case Ordering::automatic:
                               return "Automatic";
                             case Ordering::minimum_degree:
                               return "MinimumDegree";
                             default:
                               return "NestedDissection";
                           }
                         });

// Counted from what AMD says of its order, and from the columns of the factor.
TEST(EliminationOrder, KnowsItsOperations) {
  for (const OwnedMatrix& A :
       {laplacian_matrix(grid(59, 40), 1.0, 10), random_matrix(60, 1, 0.0, 0.1, 1),
        random_matrix(1, 1, 0.0, 0.1, 1)}) {
    const EliminationOrder found = minimum_degree_order(*A.pattern);
    const auto solver = make_solver();
    solver->analyze(*A.pattern, 1, found.order);
    EXPECT_NEAR(found.operations, solver->statistics().flops, 1e-9 * found.operations);
    EXPECT_EQ(found.order, fill_reducing_order(*A.pattern, Ordering::minimum_degree));
  }
}

TEST(Ordering, OfTheEmptyPatternIsEmpty) {
  EXPECT_TRUE(fill_reducing_order(BlockPattern{}).empty());
}

}  // namespace
}  // namespace lapwing
