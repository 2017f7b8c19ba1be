#include <memory>
#include <span>

#include <gtest/gtest.h>

#include "elastic/settled_edit.h"
#include "lapwing/elastic/energy_minimizer.h"
#include "lapwing/mesh/shapes.h"

namespace lapwing {
namespace {

using Eigen::Affine3d;
using Eigen::Vector3d;
using test::bumpy_tube_edit;
using test::kTerms;
using test::Settled;
using test::SettledEdit;
using test::Start;

// A thin rod bends easily, which a factor that holds every ring in its turn does not know.
TEST(SettleTangent, OfThePoseSavesIterations) {
  Mesh rod = cylinder(8, 160, 0.1, 6.0);
  EditRegion region = test::ends_of_cylinder(rod);
  const SettledEdit edit(std::move(rod), std::move(region));
  const Affine3d bend = test::turn_and_move(60, Vector3d::UnitX(), Vector3d(0, -1, -0.5));
  const SettleOptions settle{.tolerance = 1e-4, .max_iterations = 5000};
  DeformOptions options;
  options.settle = settle;
  const DeformResult by_tangent = edit.deform(bend, options);
  const Settled plain = edit.settle(bend, settle);
  EXPECT_TRUE(by_tangent.certificate.settled);
  EXPECT_LT(2 * by_tangent.certificate.settle_iterations, plain.result.iterations);
}

// A tangent that is the n x n system in every pose.
class PlainTangent : public Preconditioner {
 public:
  explicit PlainTangent(const LaplacianSystem& system) : system_(system) {}

  bool factorize(std::span<const Eigen::Matrix3d> /*transforms*/,
                 std::span<const Vector3d> /*displacement*/) override {
    return true;
  }
  void solve_in_place(std::span<double> b) override { system_.solve_in_elimination_order(b, 3); }

 private:
  const LaplacianSystem& system_;
};

// By far too short a step, as where rounding has made a factor too stiff.
class StiffTangent final : public PlainTangent {
 public:
  using PlainTangent::PlainTangent;

  void solve_in_place(std::span<double> b) override {
    solve_accurately_in_place(b);
    for (double& number : b) number *= 1e-6;
  }
  void solve_accurately_in_place(std::span<double> b) override { PlainTangent::solve_in_place(b); }
};

TEST(SettleTangent, DoesNotEndItWhereItIsTooStiff) {
  const auto settled_by = [](const SettledEdit::TangentOf& tangent_of) {
    return bumpy_tube_edit()
        .settle(
            test::turn_and_move(90, Vector3d::UnitX(), Vector3d(0, -1.5, -1)), {}, Start::linear,
            false, kTerms, [](auto run) { run(); }, tangent_of)
        .result;
  };
  const MinimizerResult right = settled_by(
      [](const LaplacianSystem& system) { return std::make_unique<PlainTangent>(system); });
  const MinimizerResult stiff = settled_by(
      [](const LaplacianSystem& system) { return std::make_unique<StiffTangent>(system); });
  ASSERT_TRUE(right.settled);
  ASSERT_TRUE(stiff.settled);
  EXPECT_LT(stiff.relative_gradient, 10.0 * right.relative_gradient);
}

}  // namespace
}  // namespace lapwing
