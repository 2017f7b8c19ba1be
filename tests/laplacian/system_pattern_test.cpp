#include "lapwing/laplacian/system_pattern.h"

#include <numeric>

#include <gtest/gtest.h>

#include "lapwing/mesh/shapes.h"
#include "lapwing/solve/block_solver.h"
#include "lapwing/solve/ordering.h"

namespace lapwing {
namespace {

SystemPattern pattern_of(const Mesh& mesh) {
  std::vector<Index> all(mesh.vertex_count());
  std::iota(all.begin(), all.end(), 0U);
  return {mesh.topology(), all, Unknowns(all, all.size())};
}

TEST(SystemPattern, HasOneOrderForBothSystemsOfAnOrdinaryRegion) {
  const Mesh mesh = icosphere(3);
  const SystemPattern pattern = pattern_of(mesh);
  EXPECT_FALSE(pattern.is_ordered());
  EXPECT_EQ(pattern.order(), fill_reducing_order(pattern.blocks()));
  EXPECT_TRUE(pattern.is_ordered());
  EXPECT_EQ(&pattern.factorization_order(), &pattern.order());
}

double flops(const SystemPattern& pattern, std::span<const int> order, int block_size = 1) {
  const auto solver = make_solver();
  solver->analyze(pattern.blocks(), block_size, order);
  return solver->statistics().flops;
}

// Regular meshes are where minimum degree is far from the best.
TEST(SystemPattern, RegularRegionHasAThoroughOrderOfFewerOperations) {
  const SystemPattern pattern = pattern_of(grid(120, 120));
  ASSERT_LT(pattern.blocks().size(), kMinimumDegreeLimit);
  EXPECT_EQ(pattern.order(), fill_reducing_order(pattern.blocks()));
  EXPECT_LT(flops(pattern, pattern.factorization_order()), 0.8 * flops(pattern, pattern.order()));
}

TEST(SystemPattern, LargeRegionHasOneThatSavesMoreThanMinimumDegree) {
  const SystemPattern pattern = pattern_of(grid(400, 400));
  ASSERT_GT(pattern.blocks().size(), kMinimumDegreeLimit);
  EXPECT_LT(flops(pattern, pattern.order()),
            0.5 * flops(pattern, fill_reducing_order(pattern.blocks(), Ordering::minimum_degree)));
  EXPECT_EQ(&pattern.factorization_order(), &pattern.order());
}

TEST(SystemPattern, KeepsTheAnalysisForAsLongAsAFactorHasIt) {
  const SystemPattern pattern = pattern_of(icosphere(3));
  std::weak_ptr<const SolverAnalysis> kept;
  {
    EXPECT_FALSE(pattern.has_analysis());
    const std::shared_ptr<const SolverAnalysis> analysis = pattern.analysis();
    EXPECT_TRUE(pattern.has_analysis());
    EXPECT_EQ(pattern.analysis(), analysis);
    const auto solver = make_solver();
    solver->analyze_as(analysis);
    EXPECT_DOUBLE_EQ(solver->statistics().flops, flops(pattern, pattern.factorization_order(), 3));
    kept = analysis;
  }
  EXPECT_TRUE(kept.expired());
  EXPECT_NE(pattern.analysis(), nullptr);
}

}  // namespace
}  // namespace lapwing
