#include "lapwing/laplacian/constrained_factor.h"

#include <numeric>

#include <gtest/gtest.h>

#include "lapwing/base/errors.h"
#include "lapwing/laplacian/weights.h"
#include "lapwing/mesh/shapes.h"

namespace lapwing {
namespace {

// A sheet with constraints. Without the constraints W, the matrix L'L is singular.
class HeldSheet : public ::testing::Test {
 protected:
  BlockMatrix normal_matrix(LaplacianWeights scheme = LaplacianWeights::uniform) const {
    const auto weights = laplacian_weights(topology_, mesh_.positions, scheme);
    return pattern_.normal().normal_matrix(laplacian_rows(topology_.rings, weights, all_));
  }

  std::vector<double> held(std::span<const Index> vertices, double weight) const {
    std::vector<double> W(mesh_.vertex_count(), 0.0);
    for (const Index v : vertices) W[v] = weight;
    return W;
  }

  ConstrainedFactor prepared(BlockMatrix A) const {
    ConstrainedFactor factor(pattern_, 1);
    factor.analyze();
    factor.set_matrix(std::move(A));
    return factor;
  }

  std::vector<double> solution(const ConstrainedFactor& factor) const {
    std::vector<double> x(mesh_.vertex_count());
    std::iota(x.begin(), x.end(), -50.0);
    factor.solver().solve(x, x, 1);
    return x;
  }

  std::vector<double> solution_from_scratch(BlockMatrix A, std::span<const double> W) const {
    ConstrainedFactor factor = prepared(std::move(A));
    factor.factorize(W);
    return solution(factor);
  }

  static std::vector<Index> all_of(const Mesh& mesh) {
    std::vector<Index> all(mesh.vertex_count());
    std::iota(all.begin(), all.end(), 0U);
    return all;
  }

  Mesh mesh_ = bumpy_plane(40, 4, 0.2);
  Topology topology_ = mesh_.topology();
  std::vector<Index> all_ = all_of(mesh_);
  SystemPattern pattern_{topology_, all_, Unknowns(all_, all_.size())};
};

TEST_F(HeldSheet, OtherHoldsGiveTheBitsOfAFactorizationFromScratch) {
  ConstrainedFactor factor = prepared(normal_matrix());
  factor.factorize(held(std::array<Index, 3>{0, 40, 1680}, 1.0));
  for (const double weight : {1.0, 0.3, 1.0}) {
    const auto W = held(std::array<Index, 4>{0, 40, 41, 900}, weight);
    factor.factorize(W);
    EXPECT_TRUE(factor.is_factorized_for(W));
    EXPECT_EQ(solution(factor), solution_from_scratch(normal_matrix(), W));
  }
}

TEST_F(HeldSheet, AnotherMatrixIsFactoredUnderTheSameHolds) {
  ConstrainedFactor factor = prepared(normal_matrix());
  const auto W = held(std::array<Index, 3>{0, 40, 1680}, 1.0);
  factor.factorize(W);
  factor.set_matrix(normal_matrix(LaplacianWeights::cotangent));
  EXPECT_FALSE(factor.is_factorized_for(W));
  factor.factorize(W);
  EXPECT_EQ(solution(factor), solution_from_scratch(normal_matrix(LaplacianWeights::cotangent), W));
}

TEST_F(HeldSheet, RefusedHoldsLeaveItReadyForOthers) {
  ConstrainedFactor factor = prepared(normal_matrix());
  const auto W = held(std::array<Index, 3>{0, 40, 1680}, 1.0);
  factor.factorize(W);
  const std::vector<double> nothing(W.size(), 0.0);
  EXPECT_THROW(factor.factorize(nothing), NotPositiveDefinite);
  EXPECT_FALSE(factor.is_factorized_for(nothing));
  factor.factorize(W);
  EXPECT_EQ(solution(factor), solution_from_scratch(normal_matrix(), W));
}

TEST_F(HeldSheet, CancelledFactorizationIsNotTakenForDone) {
  ConstrainedFactor factor = prepared(normal_matrix());
  const auto W = held(std::array<Index, 3>{0, 40, 1680}, 1.0);
  EXPECT_THROW(factor.factorize(W, [](std::string_view, double) { return false; }), Cancelled);
  EXPECT_FALSE(factor.is_factorized_for(W));
  factor.factorize(W);
  EXPECT_EQ(solution(factor), solution_from_scratch(normal_matrix(), W));
}

}  // namespace
}  // namespace lapwing
