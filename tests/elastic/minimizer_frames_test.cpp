#include <numbers>

#include <gtest/gtest.h>

#include "lapwing/deform/deform_solver.h"
#include "lapwing/deform/handle_motion.h"
#include "lapwing/elastic/energy_minimizer.h"
#include "lapwing/kernels/cpu_kernels.h"
#include "support/bent_tube.h"
#include "support/cancel_everywhere.h"
#include "support/failing_new.h"
#include "support/linear_options.h"
#include "support/rippled_cylinder.h"

namespace lapwing {
namespace {

using Eigen::Affine3d;
using Eigen::AngleAxisd;
using Eigen::Vector3d;

constexpr int kFrames = 10;

// A handle and how far it goes.
struct FollowedEdit {
  Mesh mesh;
  EditRegion region;
  Affine3d motion;
  AngleAxisd turn;

  Affine3d part(double share) const {
    return partial_motion(motion, turn, handle_frame(region.handles[0], mesh.positions).centroid,
                          share);
  }
};

FollowedEdit bent_tube() {
  const Mesh mesh = test::bumpy_tube();
  return {mesh, test::foot_and_head(mesh), test::bend(), AngleAxisd(0.6, Vector3d::UnitY())};
}

FollowedEdit twisted_cylinder() {
  const Mesh mesh = test::rippled_cylinder(30, 61);
  return {mesh, test::ends_of_cylinder(mesh),
          test::turn_and_move(60, Vector3d::UnitZ(), Vector3d(0.3, 0, 0)),
          AngleAxisd(std::numbers::pi / 3.0, Vector3d::UnitZ())};
}

SettleOptions settling(double tolerance = 1e-4) {
  return {.tolerance = tolerance, .max_iterations = 2000};
}

// A settler and where its surface is.
class MinimizedFrames {
 public:
  MinimizedFrames(FollowedEdit edit, const SettleOptions& options, bool hard = false)
      : edit_(std::move(edit)),
        topology_(edit_.mesh.topology()),
        constraints_(constraints_of(edit_.region, topology_, 1.0, hard)),
        pattern_(topology_, edit_.region.roi, constraints_.unknowns),
        system_(edit_.mesh.positions, topology_, edit_.region.roi, constraints_, pattern_,
                {LaplacianWeights::cotangent, kDefaultDetailLength}, timings_),
        settler_(kernels_, system_, options),
        linear_(edit_.mesh.positions, topology_, edit_.region, hard_options(hard), kernels_),
        u_(edit_.mesh.vertex_count(), Vector3d::Zero()) {}

  std::vector<Vector3d> prescribed(const Affine3d& motion) const {
    std::vector<Vector3d> prescribed(u_.size(), Vector3d::Zero());
    for (const Index v : edit_.region.handles[0]) {
      prescribed[v] = motion * edit_.mesh.positions[v] - edit_.mesh.positions[v];
    }
    return prescribed;
  }
  // Starts at the last frame plus the linear response to the motion of the handle since then.
  MinimizerResult follow(const Affine3d& motion) {
    const std::vector<Vector3d> to = linear(motion);
    const std::vector<Vector3d> from = linear(last_);
    for (std::size_t v = 0; v < u_.size(); ++v) u_[v] += to[v] - from[v];
    last_ = motion;
    return settler_.follow({prescribed(motion)}, u_);
  }
  // All frames of the edit's motion; their iterations.
  int follow_all() {
    int iterations = 0;
    for (int k = 1; k <= kFrames; ++k) {
      const MinimizerResult result = follow(edit_.part(k / double{kFrames}));
      EXPECT_TRUE(result.settled);
      iterations += result.iterations;
    }
    return iterations;
  }
  MinimizerResult settle_from_linear(const Affine3d& motion) {
    u_ = linear(motion);
    return settler_.settle({prescribed(motion)}, u_);
  }
  void put_back() {
    std::fill(u_.begin(), u_.end(), Vector3d::Zero());
    last_ = Affine3d::Identity();
  }

  EnergyMinimizer& settler() { return settler_; }
  const FollowedEdit& edit() const { return edit_; }
  std::vector<Vector3d>& displacement() { return u_; }
  double mean_edge() const {
    double sum = 0.0;
    for (const Vector3d& edge : system_.rings().edges) sum += edge.norm();
    return sum / static_cast<double>(system_.rings().edges.size());
  }

 private:
  static DeformOptions hard_options(bool hard) {
    DeformOptions options = test::linear_options();
    options.hard = hard;
    return options;
  }
  std::vector<Vector3d> linear(const Affine3d& motion) const {
    std::vector<Vector3d> u = linear_.solve(std::array{motion}).positions;
    for (std::size_t v = 0; v < u.size(); ++v) u[v] -= edit_.mesh.positions[v];
    return u;
  }

  FollowedEdit edit_;
  Topology topology_;
  Constraints constraints_;
  SystemPattern pattern_;
  StageTimings timings_;
  LaplacianSystem system_;
  CpuKernels kernels_;
  EnergyMinimizer settler_;
  DeformSolver linear_;
  std::vector<Vector3d> u_;
  Affine3d last_ = Affine3d::Identity();
};

class FollowedDrag : public ::testing::TestWithParam<FollowedEdit (*)()> {};

TEST_P(FollowedDrag, StaysWhereItIsWhileTheHandleIsStill) {
  MinimizedFrames drag(GetParam()(), settling());
  drag.follow_all();
  const Positions before = drag.displacement();
  const MinimizerResult again = drag.follow(drag.edit().motion);
  EXPECT_TRUE(again.settled);
  EXPECT_EQ(again.iterations, 0);
  EXPECT_EQ(drag.displacement(), before);
}

TEST_P(FollowedDrag, EndsWhereSettlingDoes) {
  constexpr double kTolerance = 1e-8;
  MinimizedFrames drag(GetParam()(), settling(kTolerance));
  drag.follow_all();
  const Positions followed = drag.displacement();
  EXPECT_TRUE(drag.settle_from_linear(drag.edit().motion).settled);
  EXPECT_LT(test::largest_distance(followed, drag.displacement()),
            100.0 * kTolerance * drag.mean_edge());
}

TEST_P(FollowedDrag, TakesFewerIterationsThanSettlingEachFrameAnew) {
  MinimizedFrames drag(GetParam()(), settling());
  int anew = 0;
  for (int k = 1; k <= kFrames; ++k) {
    anew += drag.settle_from_linear(drag.edit().part(k / double{kFrames})).iterations;
  }
  drag.put_back();
  EXPECT_LT(drag.follow_all(), anew);
}

INSTANTIATE_TEST_SUITE_P(Edits, FollowedDrag, ::testing::Values(bent_tube, twisted_cylinder),
                         [](const auto& test) {
                           return test.param == bent_tube ? "BentTube" : "TwistedCylinder";
                         });

TEST(Follow, AFrameThatMayNotGoOnIsABetterSurfaceAllTheSame) {
  MinimizedFrames drag(bent_tube(), settling());
  const auto prescribed = drag.prescribed(drag.edit().motion);
  double last = drag.settler().energy({prescribed}, drag.displacement());
  MinimizerResult frame;
  for (int frames = 0; !frame.settled; ++frames) {
    ASSERT_LT(frames, 200);
    int left = 2;
    frame = drag.settler().follow({prescribed}, drag.displacement(),
                                  [&left](double) { return left-- > 0; });
    EXPECT_LE(frame.iterations, 2);
    EXPECT_LE(frame.energy, last);
    last = frame.energy;
  }
}

// Each frame continues from the minimizer's state after the previous frame.
TEST(Follow, FramesAtRestEndWhereOneOfAllTheirIterationsDoes) {
  constexpr int kIterations = 12;
  const auto at_rest_by = [](int iterations_a_frame) {
    MinimizedFrames drag(bent_tube(), settling());
    const std::vector<Vector3d> prescribed = drag.prescribed(drag.edit().motion);
    for (int done = 0; done < kIterations; done += iterations_a_frame) {
      int left = iterations_a_frame;
      const MinimizerResult frame = drag.settler().follow_at_rest(
          {prescribed}, drag.displacement(), [&left](double) { return left-- > 0; });
      EXPECT_EQ(frame.iterations, iterations_a_frame);
    }
    return drag.displacement();
  };
  const Positions at_once = at_rest_by(kIterations);
  EXPECT_EQ(at_rest_by(1), at_once);
  EXPECT_EQ(at_rest_by(4), at_once);
}

TEST(Follow, TheEnergyIsThatOfTheTargetAsked) {
  MinimizedFrames drag(bent_tube(), settling());
  drag.follow_all();
  const std::vector<Vector3d> u = drag.displacement();
  const std::vector<Vector3d> prescribed = drag.prescribed(drag.edit().motion);
  const std::vector<Vector3d> elsewhere = drag.prescribed(drag.edit().part(0.9));
  const std::vector<Eigen::Matrix3d> same(u.size(), Eigen::Matrix3d::Identity());
  const std::vector<Eigen::Matrix3d> larger(u.size(), 1.1 * Eigen::Matrix3d::Identity());
  const std::vector<Vector3d> forces(u.size(), Vector3d(0, 0, 0.1));
  std::vector<Vector3d> moved = u;
  for (Vector3d& v : moved) v *= 1.01;
  const std::vector<std::pair<MinimizerTarget, std::span<const Vector3d>>> asked{
      {{prescribed, same}, u},
      {{elsewhere, same}, u},
      {{prescribed, larger}, u},
      {{prescribed, same, forces}, u},
      {{prescribed, same}, moved}};
  for (const auto& [target, surface] : asked) {
    MinimizedFrames other(bent_tube(), settling());
    const double expected = other.settler().energy(target, surface);
    EXPECT_EQ(drag.settler().energy(target, surface), expected);
    EXPECT_EQ(drag.settler().energy(target, surface), expected) << "asked again";
    EXPECT_NE(drag.settler().energy({prescribed, same}, moved),
              drag.settler().energy({prescribed, same}, u));
  }
  drag.settler().energy({prescribed, larger}, u);
  EXPECT_EQ(drag.settler().energy({prescribed, {}}, u),
            MinimizedFrames(bent_tube(), settling()).settler().energy({prescribed, same}, u))
      << "without stretch after a target that has some";
}

TEST(Follow, TheEnergyIsThatOfTheTargetAskedAfterACancelledOne) {
  MinimizedFrames drag(bent_tube(), settling());
  drag.follow_all();
  const std::vector<Vector3d> u = drag.displacement();
  const std::vector<Vector3d> prescribed = drag.prescribed(drag.edit().motion);
  const std::vector<Vector3d> elsewhere = drag.prescribed(drag.edit().part(0.9));
  const double expected =
      MinimizedFrames(bent_tube(), settling()).settler().energy({elsewhere, {}}, u);
  const std::size_t points = test::cancel_everywhere([&](const Progress& progress) {
    drag.settler().energy({prescribed, {}}, u);
    try {
      const ProgressScope scope(progress);
      drag.settler().energy({elsewhere, {}}, u);
    } catch (const Cancelled&) {
      EXPECT_EQ(drag.settler().energy({elsewhere, {}}, u), expected);
      throw;
    }
  });
  EXPECT_GT(points, 5U);
}

TEST(Follow, HardConstraintsAreMetExactlyInEachFrame) {
  MinimizedFrames drag(bent_tube(), settling(), true);
  for (const double share : {0.3, 0.6, 1.0}) {
    const Affine3d motion = drag.edit().part(share);
    EXPECT_TRUE(drag.follow(motion).settled);
    const std::vector<Vector3d> prescribed = drag.prescribed(motion);
    for (const Index v : drag.edit().region.handles[0]) {
      EXPECT_EQ(drag.displacement()[v], prescribed[v]);
    }
  }
}

TEST(Follow, IterationsAllocateNothingAfterTheFirstFrame) {
  const auto allocations = [](int iterations) {
    SettleOptions options = settling(1e-300);
    options.max_iterations = iterations;
    MinimizedFrames drag(bent_tube(), options);
    drag.follow(drag.edit().part(0.5));
    const std::vector<Vector3d> prescribed = drag.prescribed(drag.edit().motion);
    const test::FailingNew counting(-1);
    EXPECT_EQ(drag.settler().follow({prescribed}, drag.displacement()).iterations, iterations);
    return test::FailingNew::calls();
  };
  EXPECT_EQ(allocations(30), allocations(2));
}

}  // namespace
}  // namespace lapwing
