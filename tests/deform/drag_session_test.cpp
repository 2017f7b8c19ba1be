#include "lapwing/deform/drag_session.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <memory>
#include <numbers>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "lapwing/base/errors.h"
#include "lapwing/kernels/cpu_kernels.h"
#include "support/bent_tube.h"
#include "support/dragged.h"
#include "support/error_message.h"
#include "support/linear_options.h"
#include "support/rippled_cylinder.h"

namespace lapwing {
namespace {

using Eigen::Affine3d;
using Eigen::AngleAxisd;
using Eigen::Vector3d;
using test::largest_distance;

std::array<Affine3d, 1> twist(double degrees) {
  return {test::turn_and_move(degrees, Vector3d::UnitZ(), Vector3d::Zero())};
}

// Returns a rotation of the handle by `degrees`, which may exceed 180.
HandleMotions turned(double degrees) {
  return {{twist(degrees)[0]}, {AngleAxisd(degrees * std::numbers::pi / 180.0, Vector3d::UnitZ())}};
}

bool same(const DragState& a, const DragState& b) {
  const auto are_equal = [](const Affine3d& x, const Affine3d& y) {
    return x.matrix() == y.matrix();
  };
  return std::ranges::equal(a.motions.maps, b.motions.maps, are_equal) &&
         a.displacement == b.displacement;
}

// With this budget, a frame of the fine cylinder iterates on the coarse proxy only.
const TimeBudget kNoTime = [](double ms) { return ms == 0.0; };

// Returns a budget that lets a frame run `count` iterations.
TimeBudget iterations(int count) {
  return [left = std::make_shared<int>(count)](double) { return (*left)-- > 0; };
}

void twist_without_time(DragSession& drag, int from, int to) {
  for (int degrees = from; degrees <= to; degrees += 3) drag.step(twist(degrees), kNoTime);
}

// A rippled cylinder whose handle, at one end, twists it.
class TwistedCylinder : public ::testing::Test {
 protected:
  explicit TwistedCylinder(Mesh mesh) : mesh_(std::move(mesh)) {}

  std::shared_ptr<const DeformSolver> other_solver(const DeformOptions& options = {}) {
    return std::make_shared<const DeformSolver>(mesh_.positions, mesh_.topology(),
                                                test::ends_of_cylinder(mesh_), options, kernels_);
  }
  Positions positions(const DragState& pose) const {
    Positions positions = mesh_.positions;
    for (std::size_t v = 0; v < positions.size(); ++v) positions[v] += pose.displacement[v];
    return positions;
  }
  double distance_from_solution(const DragState& pose, double degrees) const {
    return largest_distance(positions(pose), solver_->solve(turned(degrees)).positions);
  }
  // Begins a new drag that rotates the handle by `degrees` per frame.
  DragState dragged_by(DragSession& drag, double degrees) const {
    drag.begin();
    for (int frame = 1; frame <= 4; ++frame) drag.step(twist(degrees * frame), iterations(2));
    return drag.state();
  }

  Mesh mesh_;
  CpuKernels kernels_;
  std::shared_ptr<const DeformSolver> solver_ = other_solver();
};

class DraggedCylinder : public TwistedCylinder {
 protected:
  DraggedCylinder() : TwistedCylinder(test::rippled_cylinder(30, 61)) {}
};

TEST_F(DraggedCylinder, StillHandleKeepsTheRestPositions) {
  DragSession drag(solver_);
  const DragState& pose = drag.state();
  for (int frame = 0; frame < 3; ++frame) {
    drag.step(twist(0.0));
    EXPECT_LT(largest_distance(positions(pose), mesh_.positions), 1e-9);
  }
}

// Wound by -100 the distance is 0.8.
TEST_F(DraggedCylinder, TurnOf260DegreesInFramesKeepsItsWinding) {
  DragSession drag(solver_);
  const DragState& pose = drag.state();
  for (int degrees = 10; degrees <= 260; degrees += 10) {
    drag.step(twist(degrees));
    EXPECT_TRUE(pose.last_result.settled) << degrees << " degrees";
  }
  EXPECT_NEAR(pose.motions.turns[0].angle() * 180.0 / std::numbers::pi, 260.0, 1e-6);
  EXPECT_LT(distance_from_solution(pose, 260.0), 1e-3);
}

TEST_F(DraggedCylinder, FirstFrameIsWoundByItsTurn) {
  for (const double degrees : {260.0, -100.0}) {
    DragSession drag(solver_);
    const DragState& pose = drag.state();
    drag.step(turned(degrees));
    EXPECT_LT(distance_from_solution(pose, degrees), 1e-3) << degrees << " degrees";
  }
}

TEST_F(DraggedCylinder, FramesFarApartEndWhereTheSolutionIs) {
  DragSession drag(solver_);
  const DragState& pose = drag.state();
  for (const double degrees : {120.0, 240.0, 30.0, -90.0}) {
    drag.step(turned(degrees));
    EXPECT_LT(distance_from_solution(pose, degrees), 1e-3) << degrees << " degrees";
  }
}

TEST_F(DraggedCylinder, ADragDoesNotDependOnTheOneBefore) {
  DragSession drag(solver_);
  const DragState first = dragged_by(drag, 5.0);
  dragged_by(drag, -12.0);
  EXPECT_TRUE(same(dragged_by(drag, 5.0), first));
}

// The user grabs a settled surface and does not move it.
TEST_F(DraggedCylinder, TheSameMotionAgainMovesNothing) {
  DragSession drag(solver_);
  const DragState& pose = drag.state();
  drag.step(twist(40.0));
  ASSERT_TRUE(pose.last_result.settled);
  const DragState before = pose;
  drag.step(twist(40.0));
  EXPECT_TRUE(same(pose, before));
}

TEST_F(DraggedCylinder, FramesWithoutTimeEndWhereSettlingDoes) {
  DragSession drag(solver_);
  const DragState& pose = drag.state();
  int frames = 0;
  do {
    drag.step(twist(30.0), iterations(3));
  } while (!pose.last_result.settled && ++frames < 100);
  EXPECT_GT(frames, 1);
  EXPECT_LT(distance_from_solution(pose, 30.0), 1e-3);
}

TEST_F(DraggedCylinder, AFrameBeginsNearWhereAHandleThatGoesOnTakesTheSurface) {
  DragSession drag(solver_);
  const DragState& pose = drag.state();
  for (double degrees = 0.0; degrees <= 40.0; degrees += 2.0) {
    drag.step(twist(degrees));
  }
  ASSERT_TRUE(pose.last_result.settled);
  const auto moved_from = [&](DragSession& from, double degrees) {
    return distance_from_solution(from.step(twist(degrees), iterations(0)), degrees);
  };
  DragSession alone(solver_);  // without the frames before
  alone.begin(pose);
  const double by_response = moved_from(alone, 42.0);
  // The next frame uses only the linear response.
  alone.begin(pose);
  EXPECT_LT(moved_from(alone, 38.0), 1.5 * by_response);
  EXPECT_LT(3.0 * moved_from(drag, 42.0), by_response);
}

TEST_F(DraggedCylinder, ADragFromAPoseBeginsThere) {
  const DeformResult settled = solver_->solve(turned(40.0));
  const auto pose = std::make_shared<const DragState>(
      solver_->response()->pose_at(settled.positions, turned(40.0)));
  const auto dragged_to = [&](double degrees) {
    return test::dragged(solver_->response(), twist(degrees), pose);
  };
  EXPECT_LT(largest_distance(dragged_to(40.0), settled.positions), 1e-12);
  const double moved = largest_distance(dragged_to(41.0), settled.positions);
  EXPECT_GT(moved, 1e-3);
  EXPECT_LT(moved, 2e-2);
}

TEST_F(DraggedCylinder, APoseOfALargerRegionLeavesNothingOutsideOfASmallerOne) {
  const Bounds bounds = bounds_of(mesh_.positions);
  const auto between = [&](double from, double to) {
    std::vector<Index> found;
    for (Index v = 0; v < mesh_.vertex_count(); ++v) {
      const double height =
          (mesh_.positions[v].z() - bounds.min.z()) / (bounds.max.z() - bounds.min.z());
      if (height >= from && height <= to) found.push_back(v);
    }
    return make_vertex_set(found);
  };
  EditRegion lower;
  lower.roi = between(0.0, 0.5);
  lower.belt = between(0.0, 0.05);
  lower.handles = {between(0.3, 0.4)};
  DragSession large(solver_);
  large.step(twist(20.0));
  DragSession drag(std::make_shared<const DeformSolver>(mesh_.positions, mesh_.topology(), lower,
                                                        DeformOptions(), kernels_));
  drag.begin(large.step(twist(25.0)));
  const DragState& pose = drag.state();
  for (const double degrees : {30.0, 35.0, 40.0}) {
    drag.step(twist(degrees));
    for (Index v = 0; v < mesh_.vertex_count(); ++v) {
      const bool is_inside = std::binary_search(lower.roi.begin(), lower.roi.end(), v);
      EXPECT_TRUE(is_inside || pose.displacement[v].isZero(0.0)) << v;
    }
  }
}

// This region of 7,260 vertices follows a coarse proxy.
class DraggedFineCylinder : public TwistedCylinder {
 protected:
  DraggedFineCylinder() : TwistedCylinder(test::rippled_cylinder()) {}

  DragSession prepared_drag() const {
    DragSession drag(solver_);
    drag.wait_until_prepared();
    return drag;
  }
  static void settle(DragSession& drag, double degrees) {
    const DragState& pose = drag.state();
    for (int frame = 0; frame < 400 && !pose.last_result.settled; ++frame) {
      drag.step(twist(degrees), iterations(3));
    }
    EXPECT_TRUE(pose.last_result.settled);
  }
  // Returns the distance from the solution as a fraction of the diagonal.
  double off(const DragState& pose, double degrees) const {
    return distance_from_solution(pose, degrees) / 6.2;
  }
};

// The first frame does not move the handle; it measures the time of an iteration.
TEST_F(DraggedFineCylinder, FramesThatOnlyTakeItAlongStayNearTheSolution) {
  DragSession drag = prepared_drag();
  const DragState& pose = drag.state();
  for (int degrees = 0; degrees <= 60; degrees += 3) {
    drag.step(twist(degrees), kNoTime);
    EXPECT_LE(pose.last_result.iterations, degrees == 0 ? 1 : 0);
  }
  EXPECT_LT(off(pose, 60.0), 2e-3);
}

// A frame without time queries the budget before it works on the fine surface, before one further
// iteration of the proxy, and before smoothing. A frame with time queries the budget before each
// further iteration of the proxy and before smoothing.
TEST_F(DraggedFineCylinder, AsksForTimeBeforeWhatAFrameCanDoWithout) {
  DragSession drag = prepared_drag();
  twist_without_time(drag, 0, 12);
  const auto asks = [&](double degrees, int most) {
    int count = 0;
    drag.step(twist(degrees), [&](double) { return ++count <= most; });
    return count;
  };
  EXPECT_EQ(asks(15.0, 0), 4);
  EXPECT_EQ(asks(18.0, 4), 5);
}

TEST_F(DraggedFineCylinder, EndsWhereSettlingDoes) {
  DragSession drag = prepared_drag();
  const DragState& pose = drag.state();
  for (int degrees = 0; degrees <= 30; degrees += 3) {
    drag.step(twist(degrees), iterations(1));
  }
  settle(drag, 30.0);
  EXPECT_LT(off(pose, 30.0), 1e-3);
  const DragState before = pose;
  drag.step(twist(30.0));
  EXPECT_TRUE(same(pose, before));
}

TEST_F(DraggedFineCylinder, FramesGoOnWhileTheCoarseSurfaceIsMade) {
  DragSession drag(other_solver());
  const DragState& pose = drag.state();
  for (int degrees = 0; degrees <= 60; degrees += 3) {
    drag.step(twist(degrees), kNoTime);
    EXPECT_LE(pose.last_result.iterations, 1);
  }
  settle(drag, 60.0);
  EXPECT_LT(off(pose, 60.0), 1e-3);
}

TEST_F(DraggedFineCylinder, MakingTheCoarseSurfaceCanBeCancelled) {
  DragSession drag(other_solver());
  EXPECT_THROW(drag.wait_until_prepared([](std::string_view, double) { return false; }), Cancelled);
  drag.wait_until_prepared();
}

TEST_F(DraggedFineCylinder, CanBeLeftWhileTheCoarseSurfaceIsBuilt) {
  for (int frames = 0; frames < 4; ++frames) {
    DragSession drag(other_solver());
    drag.prepare();
    drag.prepare();
    for (int frame = 0; frame < frames; ++frame) drag.step(twist(3.0 * frame), kNoTime);
    if (frames > 1) {
      EXPECT_LT(off(drag.state(), 3.0 * (frames - 1)), 0.1);
    }
  }
}

TEST_F(DraggedFineCylinder, LendsItsMemoryToTheSolverAndGoesOn) {
  DragSession drag = prepared_drag();
  twist_without_time(drag, 0, 15);
  drag.release_memory();
  const DeformResult kept = solver_->solve_from(drag.state(), turned(15.0));
  EXPECT_TRUE(kept.certificate.settled);
  twist_without_time(drag, 18, 30);
  settle(drag, 30.0);
  EXPECT_LT(off(drag.state(), 30.0), 1e-3);
}

// Without the Hessian, L-BFGS needs 17 iterations here.
TEST_F(DraggedFineCylinder, SettlesAtRestByTheHessianOfItsPose) {
  DragSession drag = prepared_drag();
  const DragState& pose = drag.state();
  twist_without_time(drag, 0, 60);
  int taken = 0;
  for (int frame = 0; frame < 100 && !pose.last_result.settled; ++frame) {
    drag.step(twist(60.0), iterations(3));
    EXPECT_LE(pose.last_result.iterations, 3);
    taken += pose.last_result.iterations;
  }
  EXPECT_TRUE(pose.last_result.settled);
  EXPECT_LT(taken, 12);
  EXPECT_LT(off(pose, 60.0), 1e-3);
}

TEST_F(DraggedFineCylinder, MovesOnWhereItWasSettlingAtRest) {
  DragSession drag = prepared_drag();
  const DragState& pose = drag.state();
  twist_without_time(drag, 0, 30);
  for (int frame = 0; frame < 6; ++frame) drag.step(twist(30.0), kNoTime);
  EXPECT_FALSE(pose.last_result.settled);
  twist_without_time(drag, 33, 45);
  EXPECT_LT(off(pose, 45.0), 2e-3);
  // The Hessian at the previous resting pose would be a poor preconditioner here.
  int frames = 0;
  for (; frames < 100 && !pose.last_result.settled; ++frames) {
    drag.step(twist(45.0), kNoTime);
  }
  EXPECT_LT(frames, 12);
  EXPECT_LT(off(pose, 45.0), 1e-3);
}

TEST_F(DraggedFineCylinder, ADragDoesNotDependOnTheOneBefore) {
  DragSession drag = prepared_drag();
  const DragState first = dragged_by(drag, 5.0);
  dragged_by(drag, -12.0);
  EXPECT_TRUE(same(dragged_by(drag, 5.0), first));
}

TEST_F(DraggedFineCylinder, GoesOnFromAPoseOfBefore) {
  DragSession drag = prepared_drag();
  const auto step = [&](double degrees) { drag.step(twist(degrees), iterations(2)); };
  for (int degrees = 0; degrees <= 12; degrees += 3) step(degrees);
  const DragState before = drag.state();
  for (int time = 0; time < 2; ++time) {
    step(15.0);
    EXPECT_LT(off(drag.state(), 15.0), 0.01);
    drag.begin(before);
  }
}

TEST_F(DraggedFineCylinder, GoesOnAtRestFromAPoseOfAnotherSolver) {
  DragSession drag = prepared_drag();
  twist_without_time(drag, 0, 12);
  DragSession other(other_solver());
  other.begin(drag.state());
  settle(other, 12.0);
  EXPECT_LT(off(other.state(), 12.0), 1e-3);
}

TEST_F(DraggedFineCylinder, CancellingLeavesThePoseAsItWas) {
  DragSession drag = prepared_drag();
  const DragState before = drag.step(twist(10.0));
  int calls = 0;
  const auto third = [&calls](std::string_view, double) { return ++calls < 3; };
  EXPECT_THROW(drag.step(twist(20.0), {}, third), Cancelled);
  EXPECT_TRUE(same(drag.state(), before));
  EXPECT_LT(off(drag.step(twist(20.0)), 20.0), 1e-3);
}

// The second step starts from the result of the first.
TEST(DraggedTwice, TwoStepsOf130DegreesTurnTheMiddleBy130) {
  const Mesh mesh = test::rippled_cylinder();
  const Topology& topology = mesh.topology();
  CpuKernels kernels;
  const Positions& start = mesh.positions;
  Positions rest = start;
  for (int step = 0; step < 2; ++step) {
    const DeformSolver deformer(rest, topology, test::ends_of_cylinder(mesh), {}, kernels);
    rest = deformer.solve(turned(130.0)).positions;
  }
  double wound = 0.0;
  double middle = 0.0;
  for (Index v = 0; v < rest.size(); v += 60) {
    const double turn =
        std::atan2(rest[v].y(), rest[v].x()) - std::atan2(start[v].y(), start[v].x());
    wound += std::remainder(turn - wound, 2.0 * std::numbers::pi);
    if (v / 60 == 60) middle = wound;
  }
  EXPECT_NEAR(wound * 180.0 / std::numbers::pi, 260.0, 2.0);
  EXPECT_NEAR(middle * 180.0 / std::numbers::pi, 130.0, 2.0);
}

TEST_F(DraggedCylinder, MotionThatIsNotFiniteLeavesThePoseAsItWas) {
  DragSession drag(solver_);
  const DragState& pose = drag.state();
  drag.step(twist(10.0));
  const DragState before = pose;
  std::array motions = twist(10.0);
  motions[0].translation().x() = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(drag.step(motions), SolverError);
  EXPECT_TRUE(same(pose, before));
}

TEST_F(DraggedCylinder, WrongNumberOfMotionsIsRefused) {
  DragSession drag(solver_);
  EXPECT_THROW(drag.step(HandleMotions()), InputError);
  drag.step(twist(10.0));
  const std::vector<Affine3d> two(2, twist(10.0)[0]);
  EXPECT_THROW(drag.step(two), InputError);
}

TEST_F(DraggedCylinder, NeedsSettlingInTheOptions) {
  const auto linear = other_solver(test::linear_options());
  EXPECT_THAT(error_message<InputError>([&] { DragSession drag(linear); }),
              ::testing::HasSubstr("\"settle\" in the deform options"));
}

}  // namespace
}  // namespace lapwing
