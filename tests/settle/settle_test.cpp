#include "lapwing/settle/settle.h"

#include <cmath>
#include <cstring>
#include <functional>
#include <limits>
#include <numbers>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "lapwing/base/errors.h"
#include "lapwing/deform/deformer.h"
#include "lapwing/deform/shape_measures.h"
#include "lapwing/kernels/cpu_kernels.h"
#include "lapwing/mesh/shapes.h"
#include "support/bent_tube.h"
#include "support/error_message.h"
#include "support/failing_new.h"
#include "support/linear_options.h"
#include "support/rippled_cylinder.h"

namespace lapwing {
namespace {

using Eigen::Affine3d;
using Eigen::Vector3d;
using ::testing::HasSubstr;
using ::testing::Le;

enum class Start { linear, rest };

struct Settled {
  Positions positions;
  SettleResult result;
};

const EnergyTerms kTerms{LaplacianWeights::cotangent, kDefaultDetailLength};

class Edit {
 public:
  Edit(Mesh mesh, EditRegion region)
      : mesh_(std::move(mesh)), topology_(mesh_.topology()), region_(std::move(region)) {}

  const Mesh& mesh() const { return mesh_; }
  const Topology& topology() const { return topology_; }
  const EditRegion& region() const { return region_; }

  Positions linear(const Affine3d& motion) const {
    CpuKernels kernels;
    const Deformer deformer(mesh_.positions, topology_, region_, test::linear_options(), kernels);
    return deformer.solve(std::vector(region_.handles.size(), motion)).positions;
  }

  // As a user gets it: from the start that Deformer chooses.
  DeformResult deform(const Affine3d& motion, const DeformOptions& options = {}) const {
    CpuKernels kernels;
    const Deformer deformer(mesh_.positions, topology_, region_, options, kernels);
    return deformer.solve(std::vector(region_.handles.size(), motion));
  }

  using TangentOf = std::function<std::unique_ptr<TurnedTangent>(const LaplacianSystem&)>;

  Settled settle(
      const Affine3d& motion, const SettleOptions& options = {}, Start start = Start::linear,
      bool hard = false, const EnergyTerms& terms = kTerms,
      const std::function<void(std::function<void()>)>& run = [](auto settle) { settle(); },
      const TangentOf& tangent_of = [](const auto&) { return nullptr; }) const {
    const Constraints constraints = constraints_of(region_, topology_, 1.0, hard);
    StageTimings timings;
    const SystemPattern pattern(topology_, region_.roi, constraints.unknowns);
    const LaplacianSystem system(mesh_.positions, topology_, region_.roi, constraints, pattern,
                                 terms, timings);
    CpuKernels kernels;
    const std::unique_ptr<TurnedTangent> tangent = tangent_of(system);
    Settler settler(kernels, system, options, tangent.get());
    std::vector<Vector3d> wanted(mesh_.vertex_count(), Vector3d::Zero());
    for (const auto& handle : region_.handles) {
      for (const Index v : handle) wanted[v] = motion * mesh_.positions[v] - mesh_.positions[v];
    }
    std::vector<Vector3d> u(mesh_.vertex_count(), Vector3d::Zero());
    if (start == Start::linear) {
      const Positions there = linear(motion);
      for (std::size_t i = 0; i < u.size(); ++i) u[i] = there[i] - mesh_.positions[i];
    }
    Settled settled{mesh_.positions, {}};
    const std::vector<Vector3d> begin = u;
    const std::vector<double> scales(u.size(), 1.0);
    run([&] {
      std::copy(begin.begin(), begin.end(), u.begin());
      settled.result = settler.settle({wanted, scales}, u);
    });
    for (std::size_t i = 0; i < u.size(); ++i) settled.positions[i] += u[i];
    return settled;
  }

  std::vector<Index> free_vertices() const {
    const Constraints constraints = constraints_of(region_, topology_, 1.0, true);
    return constraints.unknowns.vertices;
  }
  double detail_error(const Positions& positions) const {
    const auto weights = laplacian_weights(topology_, mesh_.positions, LaplacianWeights::uniform);
    return lapwing::detail_error(free_vertices(), topology_, weights, mesh_.positions, positions);
  }
  double stretch(const Positions& positions) const {
    return edge_stretch(region_.roi, topology_, mesh_.positions, positions);
  }

 private:
  Mesh mesh_;
  Topology topology_;
  EditRegion region_;
};

Edit rippled_cylinder() {
  Mesh mesh = test::rippled_cylinder();
  EditRegion region = test::ends_of_cylinder(mesh);
  return {std::move(mesh), std::move(region)};
}

Edit bumpy_tube() {
  Mesh mesh = test::bumpy_tube();
  EditRegion region = test::foot_and_head(mesh);
  return {std::move(mesh), std::move(region)};
}

// All that is held, on two handles and no belt.
Edit free_tube() {
  Mesh mesh = test::bumpy_tube();
  EditRegion region = test::foot_and_head(mesh);
  region.handles.push_back(std::move(region.belt));
  region.belt.clear();
  return {std::move(mesh), std::move(region)};
}

// ---- The table of the design notes, section 3.

struct LargeMotion {
  const char* name;
  Affine3d motion;
  double detail_error;  // with uniform Laplacians
  double edge_stretch;
};

class LargeRotations : public ::testing::TestWithParam<LargeMotion> {};

TEST_P(LargeRotations, KeepDetailWhereTheLinearResponseLosesIt) {
  const Edit edit = rippled_cylinder();
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
  const Edit edit = rippled_cylinder();
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
                    0.19, 0.095},
        LargeMotion{"Twist179", test::turn_and_move(179, Vector3d::UnitZ(), Vector3d::Zero()), 0.10,
                    0.105},
        LargeMotion{"Move", test::turn_and_move(0, Vector3d::UnitZ(), Vector3d(2, 0, 0)), 0.125,
                    0.085}),
    [](const auto& test) { return std::string(test.param.name); });

// ---- One energy.

TEST(Settle, EveryIterationLowersTheEnergy) {
  const Edit edit = bumpy_tube();
  double last = std::numeric_limits<double>::infinity();
  for (int iterations = 1; iterations <= 12; ++iterations) {
    const SettleResult result =
        edit.settle(test::bend(), {.tolerance = 1e-12, .max_iterations = iterations}, Start::rest)
            .result;
    EXPECT_EQ(result.iterations, iterations);
    EXPECT_LT(result.energy, last);
    last = result.energy;
  }
}

// Moved as a whole the surface has no energy but what rounding leaves.
TEST(Settle, WhereNoStepLowersTheEnergyItSaysSo) {
  const Affine3d moved(Eigen::Translation3d(1.0 / 3.0, 0.7, -0.1));
  const Settled settled =
      free_tube().settle(moved, {.tolerance = 1e-300, .max_iterations = 2000}, Start::rest);
  EXPECT_TRUE(settled.result.exhausted);
  EXPECT_FALSE(settled.result.settled);
  EXPECT_FALSE(free_tube().settle(moved).result.exhausted);
}

TEST(Settle, NoSmallChangeOfASettledSurfaceLowersTheEnergy) {
  const Edit edit = bumpy_tube();
  const Constraints constraints = constraints_of(edit.region(), edit.topology(), 1.0, false);
  const SystemPattern pattern(edit.topology(), edit.region().roi, constraints.unknowns);
  StageTimings timings;
  const LaplacianSystem system(edit.mesh().positions, edit.topology(), edit.region().roi,
                               constraints, pattern, kTerms, timings);
  CpuKernels kernels;
  Settler settler(kernels, system, {.tolerance = 1e-9, .max_iterations = 2000});
  std::vector<Vector3d> wanted(edit.mesh().vertex_count(), Vector3d::Zero());
  for (const Index v : edit.region().handles[0]) {
    wanted[v] = test::bend() * edit.mesh().positions[v] - edit.mesh().positions[v];
  }
  const std::vector<double> scales(wanted.size(), 1.0);
  std::vector<Vector3d> u(wanted.size(), Vector3d::Zero());
  const SettleResult settled = settler.settle({wanted, scales}, u);
  EXPECT_TRUE(settled.settled);
  EXPECT_LT(settled.relative_gradient, 1e-6);
  EXPECT_DOUBLE_EQ(settler.energy({wanted, scales}, u), settled.energy);
  for (Index v = 0; v < u.size(); v += 7) {
    for (const double change : {-1e-3, 1e-3}) {
      std::vector<Vector3d> other = u;
      other[v] += change * Vector3d(0.6, -0.3, 0.7);
      EXPECT_GT(settler.energy({wanted, scales}, other), settled.energy) << "vertex " << v;
    }
  }
}

// A thin rod bends easily, which a factor that holds every ring in its turn does not know.
TEST(Settle, TheTangentOfThePoseSavesIterations) {
  Mesh rod = cylinder(8, 160, 0.1, 6.0);
  EditRegion region = test::ends_of_cylinder(rod);
  const Edit edit(std::move(rod), std::move(region));
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

TEST(Settle, ATangentIsRenewedOnlyWhereThatTakesLessThanToGoOnByIt) {
  const auto turns_at = [](double turn_cost) {
    int turns = 0;
    const Settled settled = bumpy_tube().settle(
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

TEST(Settle, DoesNotEndByATangentThatIsTooStiff) {
  const auto settled_by = [](const Edit::TangentOf& tangent_of) {
    return bumpy_tube()
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

TEST(Settle, TwistOf179DegreesIsWoundTheWayTheHandleWent) {
  const Edit edit = rippled_cylinder();
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
  const Edit edit = bumpy_tube();
  const SettleOptions options{.tolerance = 1e-9, .max_iterations = 2000};
  const Settled a = edit.settle(test::bend(), options, Start::linear);
  const Settled b = edit.settle(test::bend(), options, Start::rest);
  EXPECT_TRUE(a.result.settled);
  EXPECT_TRUE(b.result.settled);
  EXPECT_LT(test::largest_distance(a.positions, b.positions), 1e-5);
}

TEST(Settle, StillHandleStaysStill) {
  const Edit edit = bumpy_tube();
  for (const bool hard : {false, true}) {
    const Settled settled = edit.settle(Affine3d::Identity(), {}, Start::rest, hard);
    EXPECT_EQ(settled.result.iterations, 0);
    EXPECT_LT(test::largest_distance(settled.positions, edit.mesh().positions), 1e-12);
  }
}

class SimilarityOfAllThatIsHeld : public ::testing::TestWithParam<Affine3d> {};

TEST_P(SimilarityOfAllThatIsHeld, MovesTheSurfaceAlike) {
  const Edit edit = free_tube();
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
    ::testing::Values(Affine3d(Eigen::Scaling(0.1)), Affine3d(Eigen::Scaling(2.0)),
                      Affine3d(Eigen::Scaling(10.0)), Affine3d(Eigen::Translation3d(1, 2, 3)),
                      Affine3d(Eigen::AngleAxisd(0.1, Vector3d(1, 1, 0).normalized())),
                      Affine3d(Eigen::Translation3d(1, 2, 3) *
                               Eigen::AngleAxisd(2.5, Vector3d(1, 1, 0).normalized()) *
                               Eigen::Scaling(0.5))));

// The linear response alone knows growth, too.
TEST(Settle, TheTangentScalesExactly) {
  const Edit edit = free_tube();
  const Affine3d grow(Eigen::Scaling(3.0));
  Positions expected = edit.mesh().positions;
  for (Vector3d& p : expected) p = grow * p;
  EXPECT_LT(test::largest_distance(edit.linear(grow), expected), 1e-6);
}

TEST(Settle, ResultDoesNotDependOnPlaceUnitOrOrientation) {
  const Edit edit = bumpy_tube();
  const double diagonal = bounds_of(edit.mesh().positions).diagonal();
  const Positions expected = edit.settle(test::bend()).positions;
  for (const double scale : {1e-3, 1e3}) {
    const Affine3d frame = Eigen::Translation3d(scale * 1e4 * Vector3d(1, -1, 1)) *
                           Eigen::AngleAxisd(1.1, Vector3d(1, 2, 3).normalized()) *
                           Eigen::Scaling(scale);
    Mesh moved = edit.mesh();
    for (Vector3d& p : moved.positions) p = frame * p;
    Positions result = Edit(std::move(moved), edit.region())
                           .settle(frame * test::bend() * frame.inverse())
                           .positions;
    for (Vector3d& p : result) p = frame.inverse() * p;
    EXPECT_LT(test::largest_distance(result, expected), 1e-6 * diagonal) << "scale " << scale;
  }
}

TEST(Settle, HardConstraintsAreMetExactly) {
  const Edit edit = bumpy_tube();
  const Settled settled = edit.settle(test::bend(), {}, Start::linear, true);
  for (const Index v : edit.region().handles[0]) {
    EXPECT_LT((settled.positions[v] - test::bend() * edit.mesh().positions[v]).norm(), 1e-14);
  }
  EXPECT_TRUE(settled.result.settled);
}

// ---- Details, awkward meshes, misuse.

TEST(Settle, FlatRegionsBoundariesAndEarsStayFinite) {
  Mesh sheet = grid(8, 8);
  sheet.add_face(std::array<Index, 3>{0, 1, static_cast<Index>(sheet.vertex_count())});
  sheet.positions.emplace_back(0.05, -0.1, 0.0);  // an ear: a ring of two
  EditRegion region;
  region.handles = {{40}};
  for (Index v = 0; v < sheet.vertex_count(); ++v) {
    region.roi.push_back(v);
    if (v % 9 == 8) region.belt.push_back(v);
  }
  const Edit edit(std::move(sheet), std::move(region));
  for (const double length : {0.005, 0.05, 1.0}) {
    const Settled settled = edit.settle(Affine3d(Eigen::Translation3d(0, 0, 0.4)), {}, Start::rest,
                                        false, {LaplacianWeights::cotangent, length});
    for (const Vector3d& p : settled.positions) EXPECT_TRUE(p.allFinite());
    EXPECT_LT(bounds_of(settled.positions).diagonal(),
              2.0 * bounds_of(edit.mesh().positions).diagonal());
  }
}

// Three rows of a sheet lie on one line, so that the rings of the middle one have no width and the
// triangles between them no area.
TEST(Settle, RingsOnALineStayFiniteForAllWeights) {
  Mesh sheet = grid(8, 8);
  for (Vector3d& p : sheet.positions) {
    if (p.y() > 0.3 && p.y() < 0.7) p.y() = 0.5;
  }
  EditRegion region;
  region.handles.resize(1);
  for (Index v = 0; v < sheet.vertex_count(); ++v) {
    region.roi.push_back(v);
    if (sheet.positions[v].y() == 0.0) region.belt.push_back(v);
    if (sheet.positions[v].y() == 1.0) region.handles[0].push_back(v);
  }
  const Edit edit(std::move(sheet), std::move(region));
  const Affine3d fold = Eigen::Translation3d(0.1, 0.8, 0.4) *
                        Eigen::AngleAxisd(1.2, Vector3d::UnitX()) *
                        Eigen::Translation3d(0.0, -1.0, 0.0);
  for (const auto weights : {LaplacianWeights::uniform, LaplacianWeights::cotangent}) {
    for (const double length : {0.03, 1.0}) {
      const Settled settled = edit.settle(fold, {}, Start::rest, false, {weights, length});
      for (const Vector3d& p : settled.positions) EXPECT_TRUE(p.allFinite());
      EXPECT_LT(bounds_of(settled.positions).diagonal(),
                2.0 * bounds_of(edit.mesh().positions).diagonal());
    }
  }
}

TEST(Settle, SameInputGivesTheSameBits) {
  const Edit edit = bumpy_tube();
  const Settled a = edit.settle(test::bend());
  const Settled b = edit.settle(test::bend());
  EXPECT_EQ(
      std::memcmp(a.positions.data(), b.positions.data(), a.positions.size() * sizeof(Vector3d)),
      0);
}

TEST(Settle, IterationsAllocateNothing) {
  const Edit edit = bumpy_tube();
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
  const Edit edit = bumpy_tube();
  const auto message = [&](auto change) {
    SettleOptions options;
    change(options);
    return error_message<InputError>([&] { edit.settle(test::bend(), options); });
  };
  EXPECT_THAT(message([](SettleOptions& o) { o.tolerance = 0.0; }), HasSubstr("tolerance"));
  EXPECT_THAT(message([](SettleOptions& o) { o.max_iterations = 0; }), HasSubstr("iteration"));
}

}  // namespace
}  // namespace lapwing
