#include <memory>
#include <span>

#include <gtest/gtest.h>

#include "lapwing/mesh/shapes.h"
#include "lapwing/settle/settle.h"
#include "settle/settled_edit.h"

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
class CountedTangent final : public TurnedTangent {
 public:
  CountedTangent(const LaplacianSystem& system, double turn_cost, int& turns)
      : system_(system), turn_cost_(turn_cost), turns_(turns) {}

  bool turn(std::span<const Eigen::Matrix3d> /*transforms*/,
            std::span<const Vector3d> /*displacement*/) override {
    ++turns_;
    return true;
  }
  double turn_cost() const override { return turn_cost_; }
  void solve_in_place(std::span<double> b) override { system_.solve_in_elimination_order(b, 3); }

 private:
  const LaplacianSystem& system_;
  double turn_cost_;
  int& turns_;
};

TEST(SettleTangent, IsRenewedOnlyWhereThatTakesLessThanToGoOnByIt) {
  const auto turns_at = [](double turn_cost) {
    int turns = 0;
    const Settled settled = bumpy_tube_edit().settle(
        test::turn_and_move(90, Vector3d::UnitX(), Vector3d(0, -1.5, -1)), {}, Start::linear, false,
        kTerms, [](auto run) { run(); },
        [&](const LaplacianSystem& system) {
          return std::make_unique<CountedTangent>(system, turn_cost, turns);
        });
    EXPECT_GT(settled.result.iterations, 20);
    return turns;
  };
  EXPECT_EQ(turns_at(1e9), 1);
  EXPECT_GE(turns_at(0.0), 3);
}

// By far too short a step, as where rounding has made a factor too stiff.
class StiffTangent final : public TurnedTangent {
 public:
  explicit StiffTangent(const LaplacianSystem& system) : system_(system) {}

  bool turn(std::span<const Eigen::Matrix3d> /*transforms*/,
            std::span<const Vector3d> /*displacement*/) override {
    return true;
  }
  double turn_cost() const override { return 1e9; }
  void solve_in_place(std::span<double> b) override {
    solve_well_in_place(b);
    for (double& number : b) number *= 1e-6;
  }
  void solve_well_in_place(std::span<double> b) override {
    system_.solve_in_elimination_order(b, 3);
  }

 private:
  const LaplacianSystem& system_;
};

TEST(SettleTangent, DoesNotEndItWhereItIsTooStiff) {
  const auto settled_by = [](const SettledEdit::TangentOf& tangent_of) {
    return bumpy_tube_edit()
        .settle(
            test::turn_and_move(90, Vector3d::UnitX(), Vector3d(0, -1.5, -1)), {}, Start::linear,
            false, kTerms, [](auto run) { run(); }, tangent_of)
        .result;
  };
  int turns = 0;
  const SettleResult right = settled_by([&](const LaplacianSystem& system) {
    return std::make_unique<CountedTangent>(system, 1e9, turns);
  });
  const SettleResult stiff = settled_by(
      [](const LaplacianSystem& system) { return std::make_unique<StiffTangent>(system); });
  ASSERT_TRUE(right.settled);
  ASSERT_TRUE(stiff.settled);
  EXPECT_LT(stiff.relative_gradient, 10.0 * right.relative_gradient);
}

}  // namespace
}  // namespace lapwing
