#include "lapwing/elastic/energy_minimizer.h"

#include <cmath>
#include <functional>
#include <limits>
#include <numbers>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "elastic/settled_edit.h"
#include "lapwing/base/errors.h"
#include "lapwing/deform/deform_solver.h"
#include "lapwing/deform/shape_measures.h"
#include "lapwing/kernels/cpu_kernels.h"
#include "lapwing/mesh/shapes.h"
#include "support/error_message.h"
#include "support/failing_new.h"

namespace lapwing {
namespace {

using Eigen::Affine3d;
using Eigen::Vector3d;
using test::bumpy_tube_edit;
using test::free_tube_edit;
using test::kTerms;
using test::rippled_cylinder_edit;
using test::Settled;
using test::SettledEdit;
using test::Start;
using ::testing::HasSubstr;
using ::testing::Le;

// ---- Detail against stretch on a rippled tube.

struct LargeMotion {
  const char* name;
  Affine3d motion;
  double detail_error;  // with uniform Laplacians
  double edge_stretch;
};

class LargeRotations : public ::testing::TestWithParam<LargeMotion> {};

TEST_P(LargeRotations, KeepDetailWhereTheLinearResponseLosesIt) {
  const SettledEdit edit = rippled_cylinder_edit();
  const LargeMotion& expected = GetParam();
  const DeformResult result = edit.deform(expected.motion);
  EXPECT_TRUE(result.certificate.settled);
  EXPECT_EQ(result.certificate.flipped_triangles, 0U);
  const double detail_error = edit.detail_error(result.positions);
  EXPECT_THAT(detail_error, Le(expected.detail_error));
  EXPECT_LT(detail_error, edit.detail_error(edit.linear(expected.motion)));
  EXPECT_THAT(result.certificate.edge_stretch, Le(expected.edge_stretch));
}

TEST_P(LargeRotations, ASmallerDetailLengthTradesDetailForLength) {
  const SettledEdit edit = rippled_cylinder_edit();
  DeformOptions options;
  const DeformResult usual = edit.deform(GetParam().motion, options);
  options.detail_length *= 0.5;
  const DeformResult stiffer = edit.deform(GetParam().motion, options);
  EXPECT_TRUE(stiffer.certificate.settled);
  EXPECT_LT(stiffer.certificate.edge_stretch, usual.certificate.edge_stretch);
  EXPECT_GT(edit.detail_error(stiffer.positions), edit.detail_error(usual.positions));
}

INSTANTIATE_TEST_SUITE_P(
    Table, LargeRotations,
    ::testing::Values(
        LargeMotion{"Bend90", test::turn_and_move(90, Vector3d::UnitX(), Vector3d(0, -1.5, -1)),
                    0.195, 0.095},
        LargeMotion{"Twist179", test::turn_and_move(179, Vector3d::UnitZ(), Vector3d::Zero()), 0.10,
                    0.105},
        LargeMotion{"Move", test::turn_and_move(0, Vector3d::UnitZ(), Vector3d(2, 0, 0)), 0.125,
                    0.085}),
    [](const auto& test) { return std::string(test.param.name); });

// ---- One energy.

TEST(Settle, EveryIterationLowersTheEnergy) {
  const SettledEdit edit = bumpy_tube_edit();
  double last = std::numeric_limits<double>::infinity();
  for (int iterations = 1; iterations <= 12; ++iterations) {
    const MinimizerResult result =
        edit.settle(test::bend(), {.tolerance = 1e-12, .max_iterations = iterations}, Start::rest)
            .result;
    EXPECT_EQ(result.iterations, iterations);
    EXPECT_LT(result.energy, last);
    last = result.energy;
  }
}

// The energy of a rigidly moved surface is 0 except for rounding errors.
TEST(Settle, WhereNoStepLowersTheEnergyItSaysSo) {
  const Affine3d moved(Eigen::Translation3d(1.0 / 3.0, 0.7, -0.1));
  const Settled settled =
      free_tube_edit().settle(moved, {.tolerance = 1e-300, .max_iterations = 2000}, Start::rest);
  EXPECT_TRUE(settled.result.exhausted);
  EXPECT_FALSE(settled.result.settled);
  EXPECT_FALSE(free_tube_edit().settle(moved).result.exhausted);
}

TEST(Settle, NoSmallChangeOfASettledSurfaceLowersTheEnergy) {
  const SettledEdit edit = bumpy_tube_edit();
  const Constraints constraints = constraints_of(edit.region(), edit.topology(), 1.0, false);
  const SystemPattern pattern(edit.topology(), edit.region().roi, constraints.unknowns);
  StageTimings timings;
  const LaplacianSystem system(edit.mesh().positions, edit.topology(), edit.region().roi,
                               constraints, pattern, kTerms, timings);
  CpuKernels kernels;
  EnergyMinimizer settler(kernels, system, {.tolerance = 1e-9, .max_iterations = 2000});
  std::vector<Vector3d> prescribed(edit.mesh().vertex_count(), Vector3d::Zero());
  for (const Index v : edit.region().handles[0]) {
    prescribed[v] = test::bend() * edit.mesh().positions[v] - edit.mesh().positions[v];
  }
  std::vector<Vector3d> u(prescribed.size(), Vector3d::Zero());
  const MinimizerResult settled = settler.settle({prescribed}, u);
  EXPECT_TRUE(settled.settled);
  EXPECT_LT(settled.relative_gradient, 1e-6);
  EXPECT_DOUBLE_EQ(settler.energy({prescribed}, u), settled.energy);
  for (Index v = 0; v < u.size(); v += 7) {
    for (const double change : {-1e-3, 1e-3}) {
      std::vector<Vector3d> other = u;
      other[v] += change * Vector3d(0.6, -0.3, 0.7);
      EXPECT_GT(settler.energy({prescribed}, other), settled.energy) << "vertex " << v;
    }
  }
}

TEST(Settle, TwistOf179DegreesIsWoundTheWayTheHandleWent) {
  const SettledEdit edit = rippled_cylinder_edit();
  const Positions result =
      edit.deform(test::turn_and_move(179, Vector3d::UnitZ(), Vector3d::Zero())).positions;
  double wound = 0.0;
  for (Index v = 0; v < result.size(); v += 60) {
    const Vector3d& from = edit.mesh().positions[v];
    const double turn = std::atan2(result[v].y(), result[v].x()) - std::atan2(from.y(), from.x());
    wound += std::remainder(turn - wound, 2.0 * std::numbers::pi);
  }
  EXPECT_NEAR(wound * 180.0 / std::numbers::pi, 179.0, 1.0);
}

// ---- Invariances.

TEST(Settle, ModerateMotionSettlesToTheSameShapeFromAnywhere) {
  const SettledEdit edit = bumpy_tube_edit();
  const SettleOptions options{.tolerance = 1e-9, .max_iterations = 2000};
  const Settled a = edit.settle(test::bend(), options, Start::linear);
  const Settled b = edit.settle(test::bend(), options, Start::rest);
  EXPECT_TRUE(a.result.settled);
  EXPECT_TRUE(b.result.settled);
  EXPECT_LT(test::largest_distance(a.positions, b.positions), 1e-5);
}

class SimilarityOfAllThatIsHeld : public ::testing::TestWithParam<Affine3d> {};

TEST_P(SimilarityOfAllThatIsHeld, MovesTheSurfaceAlike) {
  const SettledEdit edit = free_tube_edit();
  const Affine3d& motion = GetParam();
  const DeformResult result = edit.deform(motion);
  Positions expected = edit.mesh().positions;
  for (Vector3d& p : expected) p = motion * p;
  EXPECT_LT(test::largest_distance(result.positions, expected),
            1e-6 * bounds_of(expected).diagonal());
  EXPECT_LT(result.certificate.detail_error, 1e-6);
  EXPECT_LT(result.certificate.edge_stretch, 1e-6);
  EXPECT_EQ(result.certificate.flipped_triangles, 0U);
}

INSTANTIATE_TEST_SUITE_P(
    All, SimilarityOfAllThatIsHeld,
    ::testing::Values(
        Affine3d(Eigen::Scaling(0.1)), Affine3d(Eigen::Scaling(2.0)),
        Affine3d(Eigen::Scaling(10.0)), Affine3d(Eigen::Translation3d(1, 2, 3)),
        Affine3d(Eigen::Scaling(1.0, 0.7, 1.6)),
        Affine3d(Eigen::AngleAxisd(0.8, Vector3d::UnitX()) * Eigen::Scaling(1.3, 1.0, 0.5)),
        Affine3d(Eigen::AngleAxisd(0.1, Vector3d(1, 1, 0).normalized())),
        Affine3d(Eigen::Translation3d(1, 2, 3) *
                 Eigen::AngleAxisd(2.5, Vector3d(1, 1, 0).normalized()) * Eigen::Scaling(0.5))));

// If the handle scales, the linear response scales the surface exactly.
TEST(Settle, TheTangentScalesExactly) {
  const SettledEdit edit = free_tube_edit();
  const Affine3d grow(Eigen::Scaling(3.0));
  Positions expected = edit.mesh().positions;
  for (Vector3d& p : expected) p = grow * p;
  EXPECT_LT(test::largest_distance(edit.linear(grow), expected), 1e-6);
}

// ---- Degenerate meshes and invalid calls.

class AwkwardSheet : public ::testing::Test {
 protected:
  // Settles with each kind of Laplacian weights and two detail lengths.
  void expect_bounded(const Affine3d& motion) const {
    const SettledEdit edit(sheet_, region_);
    for (const auto weights : {LaplacianWeights::uniform, LaplacianWeights::cotangent}) {
      for (const double length : {0.03, 1.0}) {
        const Settled settled = edit.settle(motion, {}, Start::rest, false, {weights, length});
        for (const Vector3d& p : settled.positions) EXPECT_TRUE(p.allFinite());
        EXPECT_LT(bounds_of(settled.positions).diagonal(),
                  2.0 * bounds_of(sheet_.positions).diagonal());
      }
    }
  }
  // Holds the vertices at y = 0 and moves those at y = 1.
  void hold_rims() {
    region_.handles.resize(1);
    for (Index v = 0; v < sheet_.vertex_count(); ++v) {
      region_.roi.push_back(v);
      if (sheet_.positions[v].y() == 0.0) region_.belt.push_back(v);
      if (sheet_.positions[v].y() == 1.0) region_.handles[0].push_back(v);
    }
  }

  Mesh sheet_ = grid(8, 8);
  EditRegion region_;
};

TEST_F(AwkwardSheet, WithARingOfTwoStaysFinite) {
  hold_rims();
  const auto ear = static_cast<Index>(sheet_.vertex_count());
  sheet_.add_face(std::array<Index, 3>{0, 9, ear});
  sheet_.positions.emplace_back(-0.1, 0.05, 0.0);
  region_.roi.push_back(ear);
  expect_bounded(Affine3d(Eigen::Translation3d(0, 0, 0.4)));
}

// Three rows of vertices are collinear, so that the one-rings of the middle row have no width and
// the triangles between the rows have no area.
TEST_F(AwkwardSheet, WithRingsOnALineStaysFinite) {
  for (Vector3d& p : sheet_.positions) {
    if (p.y() > 0.3 && p.y() < 0.7) p.y() = 0.5;
  }
  hold_rims();
  expect_bounded(Eigen::Translation3d(0.1, 0.8, 0.4) * Eigen::AngleAxisd(1.2, Vector3d::UnitX()) *
                 Eigen::Translation3d(0.0, -1.0, 0.0));
}

TEST(Settle, IterationsAllocateNothing) {
  const SettledEdit edit = bumpy_tube_edit();
  const auto allocations = [&](int iterations) {
    const SettleOptions options{.tolerance = 1e-300, .max_iterations = iterations};
    long calls = 0;
    edit.settle(test::bend(), options, Start::linear, false, kTerms, [&](auto settle) {
      settle();  // solvers take their memory in the first solve
      const test::FailingNew counting(-1);
      settle();
      calls = test::FailingNew::calls();
    });
    return calls;
  };
  EXPECT_EQ(allocations(30), allocations(2));
}

TEST(Settle, OptionsOutOfRangeAreRefused) {
  const SettledEdit edit = bumpy_tube_edit();
  const auto message = [&](auto change) {
    SettleOptions options;
    change(options);
    return error_message<InputError>([&] { edit.settle(test::bend(), options); });
  };
  EXPECT_THAT(message([](SettleOptions& o) { o.tolerance = 0.0; }), HasSubstr("tolerance"));
  EXPECT_THAT(message([](SettleOptions& o) { o.max_iterations = 0; }), HasSubstr("iteration"));
}

// The n x n matrix resists every rotation of a one-ring. Its steps become shorter than the
// tolerance while a long tube is still far from the minimum.
TEST(Settle, ALongTubeIsSettledToItsToleranceHoweverLittleItsEndMoves) {
  const Mesh mesh = test::rippled_cylinder();
  const Topology& topology = mesh.topology();
  const EditRegion region = test::ends_of_cylinder(mesh);
  CpuKernels kernels;
  DeformOptions options = DeformParameters{};
  DeformOptions to_the_end = options;
  to_the_end.settle = SettleOptions{.tolerance = 1e-9, .max_iterations = 1000};
  const DeformSolver deformer(mesh.positions, topology, region, options, kernels);
  const DeformSolver reference(mesh.positions, topology, region, to_the_end, kernels);
  double edges = 0.0;
  for (std::size_t v = 0; v < mesh.vertex_count(); ++v) {
    for (const Index j : topology.rings[static_cast<Index>(v)]) {
      edges += (mesh.positions[v] - mesh.positions[j]).norm();
    }
  }
  const double mean_edge = edges / static_cast<double>(topology.rings.values.size());
  for (const double by : {1e-5, 1e-4, 3e-4, 1e-3, 1e-2, 1e-1, 1.0}) {
    const std::array aside{Affine3d(Eigen::Translation3d(6.0 * by, 0.0, 0.0))};
    EXPECT_LE(
        test::largest_distance(deformer.solve(aside).positions, reference.solve(aside).positions),
        options.settle->tolerance * mean_edge)
        << by;
  }
}

// The n x n matrix resists every rotation of a one-ring, so its steps bend a thin rod slowly.
TEST(PoseHessianOfASurface, OfThePoseSavesIterations) {
  Mesh rod = cylinder(8, 160, 0.1, 6.0);
  EditRegion region = test::ends_of_cylinder(rod);
  const SettledEdit edit(std::move(rod), std::move(region));
  const Affine3d bend = test::turn_and_move(60, Vector3d::UnitX(), Vector3d(0, -1, -0.5));
  const SettleOptions settle{.tolerance = 1e-4, .max_iterations = 5000};
  DeformOptions options;
  options.settle = settle;
  const DeformResult by_hessian = edit.deform(bend, options);
  const Settled plain = edit.settle(bend, settle);
  EXPECT_TRUE(by_hessian.certificate.settled);
  EXPECT_LT(2 * by_hessian.certificate.settle_iterations, plain.result.iterations);
}

// A preconditioner that uses the n x n system at every pose.
class PlainFactor : public Preconditioner {
 public:
  explicit PlainFactor(const LaplacianSystem& system) : system_(system) {}

  bool factorize(std::span<const Eigen::Matrix3d> /*transforms*/,
                 std::span<const Vector3d> /*displacement*/) override {
    return true;
  }
  void solve_in_place(std::span<double> b) override { system_.solve_in_elimination_order(b, 3); }

 private:
  const LaplacianSystem& system_;
};

// The steps of this preconditioner are far too short, like those of a factor that rounding errors
// made too stiff.
class StiffFactor final : public PlainFactor {
 public:
  using PlainFactor::PlainFactor;

  void solve_in_place(std::span<double> b) override {
    solve_accurately_in_place(b);
    for (double& number : b) number *= 1e-6;
  }
  void solve_accurately_in_place(std::span<double> b) override { PlainFactor::solve_in_place(b); }
};

TEST(PoseHessianOfASurface, DoesNotEndItWhereItIsTooStiff) {
  const auto settled_by = [](const SettledEdit::TangentOf& tangent_of) {
    return bumpy_tube_edit()
        .settle(
            test::turn_and_move(90, Vector3d::UnitX(), Vector3d(0, -1.5, -1)), {}, Start::linear,
            false, kTerms, [](auto run) { run(); }, tangent_of)
        .result;
  };
  const MinimizerResult right = settled_by(
      [](const LaplacianSystem& system) { return std::make_unique<PlainFactor>(system); });
  const MinimizerResult stiff = settled_by(
      [](const LaplacianSystem& system) { return std::make_unique<StiffFactor>(system); });
  ASSERT_TRUE(right.settled);
  ASSERT_TRUE(stiff.settled);
  EXPECT_LT(stiff.relative_gradient, 10.0 * right.relative_gradient);
}

}  // namespace
}  // namespace lapwing
