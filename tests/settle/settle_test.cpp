#include "lapwing/settle/settle.h"

#include <cmath>
#include <cstring>
#include <functional>
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

class Edit {
 public:
  Edit(Mesh mesh, EditRegion region)
      : mesh_(std::move(mesh)), topology_(build_topology(mesh_)), region_(std::move(region)) {}

  const Mesh& mesh() const { return mesh_; }
  const Topology& topology() const { return topology_; }
  const EditRegion& region() const { return region_; }

  Positions linear(const Affine3d& motion) const {
    CpuKernels kernels;
    const Deformer deformer(mesh_.positions, topology_, region_, {}, kernels);
    return deformer.solve(std::vector(region_.handles.size(), motion)).positions;
  }

  // As a user gets it: from the start that Deformer chooses.
  DeformResult deform(const Affine3d& motion, const SettleOptions& settle = {}) const {
    CpuKernels kernels;
    DeformOptions options;
    options.settle = settle;
    const Deformer deformer(mesh_.positions, topology_, region_, options, kernels);
    return deformer.solve(std::vector(region_.handles.size(), motion));
  }

  Settled settle(
      const Affine3d& motion, const SettleOptions& options = {}, Start start = Start::linear,
      bool hard = false,
      const std::function<void(std::function<void()>)>& run = [](auto settle) { settle(); }) const {
    const Constraints constraints = constraints_of(region_, topology_, 1.0, hard);
    StageTimings timings;
    const SystemPattern pattern(topology_, region_.roi, constraints.unknowns);
    const LaplacianSystem system(mesh_.positions, topology_, region_.roi, constraints, pattern,
                                 options.weights, options.stretch_resistance, timings);
    CpuKernels kernels;
    Settler settler(kernels, system, options);
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
    run([&] {
      std::copy(begin.begin(), begin.end(), u.begin());
      settled.result = settler.settle(wanted, u);
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

// ---- The table of the design notes, section 3.

struct LargeMotion {
  const char* name;
  Affine3d motion;
  double detail_error;
  double edge_stretch;
  double resisted_detail_error;  // with mu = 0.001
};

class LargeRotations : public ::testing::TestWithParam<LargeMotion> {};

TEST_P(LargeRotations, KeepDetailWhereTheLinearSolutionLosesIt) {
  const Edit edit = rippled_cylinder();
  const LargeMotion& expected = GetParam();
  const DeformResult result = edit.deform(expected.motion);
  EXPECT_TRUE(result.certificate.settled);
  EXPECT_THAT(result.certificate.detail_error, Le(expected.detail_error));
  EXPECT_LT(result.certificate.detail_error, edit.detail_error(edit.linear(expected.motion)));
  EXPECT_NEAR(result.certificate.edge_stretch, expected.edge_stretch, 0.1 * expected.edge_stretch);
}

TEST_P(LargeRotations, StretchResistanceTradesALittleDetailForLength) {
  const Edit edit = rippled_cylinder();
  const Certificate free = edit.deform(GetParam().motion).certificate;
  SettleOptions options;
  options.stretch_resistance = 0.001;
  const Certificate resisted = edit.deform(GetParam().motion, options).certificate;
  EXPECT_TRUE(resisted.settled);
  EXPECT_LT(resisted.edge_stretch, free.edge_stretch);
  EXPECT_THAT(resisted.detail_error, Le(GetParam().resisted_detail_error));
}

INSTANTIATE_TEST_SUITE_P(
    Table, LargeRotations,
    ::testing::Values(
        LargeMotion{"Bend90", test::turn_and_move(90, Vector3d::UnitX(), Vector3d(0, -1.5, -1)),
                    0.16, 0.116, 0.17},
        LargeMotion{"Twist179", test::turn_and_move(179, Vector3d::UnitZ(), Vector3d::Zero()), 0.07,
                    0.100, 0.08},
        LargeMotion{"Move", test::turn_and_move(0, Vector3d::UnitZ(), Vector3d(2, 0, 0)), 0.11,
                    0.080, 0.115}),
    [](const auto& test) { return std::string(test.param.name); });

TEST(Settle, AccelerationSavesIterations) {
  const Edit edit = rippled_cylinder();
  const Affine3d twist = test::turn_and_move(179, Vector3d::UnitZ(), Vector3d::Zero());
  SettleOptions options;
  options.stretch_resistance = 0.001;
  const DeformResult accelerated = edit.deform(twist, options);
  options.accelerate = false;
  const DeformResult plain = edit.deform(twist, options);
  EXPECT_LT(3 * accelerated.certificate.settle_iterations, plain.certificate.settle_iterations);
  EXPECT_LT(test::largest_distance(accelerated.positions, plain.positions), 1e-3);
}

// From the linear solution it would settle at -181.
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
  SettleOptions options;
  options.tolerance = 1e-9;
  options.max_iterations = 2000;
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
    EXPECT_EQ(settled.result.iterations, 1);
    EXPECT_LT(test::largest_distance(settled.positions, edit.mesh().positions), 1e-12);
  }
}

TEST(Settle, RigidMotionOfAllThatIsHeldMovesEverythingRigidly) {
  Mesh mesh = test::bumpy_tube();
  EditRegion region = test::foot_and_head(mesh);
  region.handles[0].insert(region.handles[0].begin(), region.belt.begin(), region.belt.end());
  region.belt.clear();
  const Edit edit(std::move(mesh), std::move(region));
  const Affine3d motion =
      Eigen::Translation3d(1, 2, 3) * Eigen::AngleAxisd(2.5, Vector3d(1, 1, 0).normalized());
  SettleOptions options;
  options.tolerance = 1e-9;
  options.max_iterations = 500;
  const Settled settled = edit.settle(motion, options);
  Positions expected = edit.mesh().positions;
  for (Vector3d& p : expected) p = motion * p;
  EXPECT_LT(test::largest_distance(settled.positions, expected), 1e-5);
  EXPECT_LT(edit.detail_error(settled.positions), 1e-5);
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

// All that is held grows by the factor 2: details that follow grow with it, exactly.
TEST(Settle, DetailsKeepTheirSizeOrFollow) {
  Mesh mesh = test::bumpy_tube();
  EditRegion region = test::foot_and_head(mesh);
  region.handles[0].insert(region.handles[0].begin(), region.belt.begin(), region.belt.end());
  region.belt.clear();
  const Edit edit(std::move(mesh), std::move(region));
  const Affine3d grow(Eigen::Scaling(2.0));
  const auto size_of_details = [&](const Positions& positions) {
    const auto& rings = edit.topology().rings;
    const auto weights =
        laplacian_weights(edit.topology(), edit.mesh().positions, LaplacianWeights::uniform);
    const std::vector<Index> rows = edit.free_vertices();
    std::vector<Vector3d> laplacians(rows.size());
    CpuKernels().sample_laplacians({positions, rings, weights, rows}, laplacians);
    double sum = 0.0;
    for (const Vector3d& d : laplacians) sum += d.squaredNorm();
    return std::sqrt(sum);
  };
  const double rest = size_of_details(edit.mesh().positions);
  SettleOptions follow;
  follow.details = Details::follow;
  EXPECT_NEAR(size_of_details(edit.settle(grow, follow).positions), 2.0 * rest, 1e-3 * rest);
  EXPECT_LT(size_of_details(edit.settle(grow).positions), 1.5 * rest);
}

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
  for (const double mu : {0.0, 0.01, 1.0}) {
    SettleOptions options;
    options.stretch_resistance = mu;
    const Settled settled =
        edit.settle(Affine3d(Eigen::Translation3d(0, 0, 0.4)), options, Start::rest);
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
    for (const double mu : {0.0, 0.01}) {
      SettleOptions options;
      options.weights = weights;
      options.stretch_resistance = mu;
      const Settled settled = edit.settle(fold, options, Start::rest);
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
  const auto allocations = [&](int iterations, double mu) {
    SettleOptions options;
    options.max_iterations = iterations;
    options.tolerance = 1e-300;
    options.stretch_resistance = mu;
    long calls = 0;
    edit.settle(test::bend(), options, Start::linear, false, [&](auto settle) {
      settle();  // solvers take their memory in the first solve
      const test::FailingNew counting(-1);
      settle();
      calls = test::FailingNew::calls();
    });
    return calls;
  };
  for (const double mu : {0.0, 0.1}) EXPECT_EQ(allocations(30, mu), allocations(2, mu));
}

TEST(Settle, OptionsOutOfRangeAreRefused) {
  const Edit edit = bumpy_tube();
  const auto message = [&](auto change) {
    SettleOptions options;
    change(options);
    return error_message<InputError>([&] { edit.settle(test::bend(), options); });
  };
  EXPECT_THAT(message([](SettleOptions& o) { o.tolerance = 0.0; }), HasSubstr("tolerance"));
  EXPECT_THAT(message([](SettleOptions& o) { o.stretch_resistance = -1.0; }),
              HasSubstr("stretch resistance"));
  EXPECT_THAT(message([](SettleOptions& o) { o.max_iterations = 0; }), HasSubstr("iteration"));
}

}  // namespace
}  // namespace lapwing
