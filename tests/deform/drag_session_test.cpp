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

// The same, past half a turn, too.
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

// A frame that is cancelled leaves the pose as it was.
void cancel_a_frame_between(double from, double to, DragSession& drag) {
  const DragState before = drag.step(twist(from));
  int calls = 0;
  const auto third = [&calls](std::string_view, double) { return ++calls < 3; };
  EXPECT_THROW(drag.step(twist(to), {}, third), Cancelled);
  EXPECT_TRUE(same(drag.state(), before));
}

class DraggedCylinder : public ::testing::Test {
 protected:
  Positions positions(const DragState& pose) const {
    Positions positions = mesh_.positions;
    for (std::size_t v = 0; v < positions.size(); ++v) positions[v] += pose.displacement[v];
    return positions;
  }
  double distance_from_solution(const DragState& pose, double degrees) const {
    return largest_distance(positions(pose), solver_->solve(turned(degrees)).positions);
  }

  Mesh mesh_ = test::rippled_cylinder(30, 61);
  Topology topology_ = mesh_.topology();
  CpuKernels kernels_;
  std::shared_ptr<const DeformSolver> solver_ = std::make_shared<const DeformSolver>(
      mesh_.positions, topology_, test::ends_of_cylinder(mesh_), DeformOptions(), kernels_);
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
  const auto dragged_by = [&](double degrees) {
    drag.begin();
    for (int frame = 1; frame <= 4; ++frame) drag.step(twist(degrees * frame));
    return drag.state();
  };
  const DragState first = dragged_by(5.0);
  dragged_by(-12.0);
  EXPECT_TRUE(same(dragged_by(5.0), first));
}

TEST_F(DraggedCylinder, CancellingLeavesThePoseAsItWas) {
  DragSession drag(solver_);
  cancel_a_frame_between(10.0, 20.0, drag);
  EXPECT_LT(distance_from_solution(drag.step(twist(20.0)), 20.0), 1e-3);
}

// Grabbing what has settled, and not moving it.
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
    int left = 3;
    drag.step(twist(30.0), [&left](double) { return left-- > 0; });
  } while (!pose.last_result.settled && ++frames < 100);
  EXPECT_GT(frames, 1);
  EXPECT_LT(distance_from_solution(pose, 30.0), 1e-3);
}

// Of a frame that has no time at all: where it begins.
TEST_F(DraggedCylinder, AFrameBeginsNearWhereAHandleThatGoesOnTakesTheSurface) {
  const auto no_time = [](double) { return false; };
  DragSession drag(solver_);
  const DragState& pose = drag.state();
  for (double degrees = 0.0; degrees <= 40.0; degrees += 2.0) {
    drag.step(twist(degrees));
  }
  ASSERT_TRUE(pose.last_result.settled);
  const auto moved_from = [&](DragSession& from, double degrees) {
    return distance_from_solution(from.step(twist(degrees), no_time), degrees);
  };
  DragSession alone(solver_);  // without the frames before
  alone.begin(pose);
  const double by_response = moved_from(alone, 42.0);
  // Back the linear response alone takes it.
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
  DragSession drag(std::make_shared<const DeformSolver>(mesh_.positions, topology_, lower,
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

// Of 7,260 vertices, which a coarse proxy carries along.
class DraggedFineCylinder : public ::testing::Test {
 protected:
  DragSession prepared_drag() const {
    DragSession drag(solver_);
    drag.wait_until_prepared();
    return drag;
  }
  std::shared_ptr<const DeformSolver> other_solver() const {
    return std::make_shared<const DeformSolver>(mesh_.positions, mesh_.topology(),
                                                test::ends_of_cylinder(mesh_), DeformOptions(),
                                                kernels_);
  }
  // By three iterations a frame.
  static void settle(DragSession& drag, double degrees) {
    const DragState& pose = drag.state();
    for (int frame = 0; frame < 400 && !pose.last_result.settled; ++frame) {
      int left = 3;
      drag.step(twist(degrees), [&left](double) { return left-- > 0; });
    }
    EXPECT_TRUE(pose.last_result.settled);
  }
  double off(const DragState& pose, double degrees) const {
    const Positions solved = solver_->solve(turned(degrees)).positions;
    double most = 0.0;
    for (std::size_t v = 0; v < solved.size(); ++v) {
      most = std::max(most, (mesh_.positions[v] + pose.displacement[v] - solved[v]).norm());
    }
    return most / kDiagonal;
  }

  static constexpr double kDiagonal = 6.2;
  Mesh mesh_ = test::rippled_cylinder();
  mutable CpuKernels kernels_;
  std::shared_ptr<const DeformSolver> solver_ = std::make_shared<const DeformSolver>(
      mesh_.positions, mesh_.topology(), test::ends_of_cylinder(mesh_), DeformOptions(), kernels_);
};

// Of one frame at rest before, whose iteration tells how long one takes, and of frames that have
// time for the coarse surface alone, from the first that moves.
TEST_F(DraggedFineCylinder, FramesThatOnlyTakeItAlongStayNearTheSolution) {
  DragSession drag = prepared_drag();
  const DragState& pose = drag.state();
  for (int degrees = 0; degrees <= 60; degrees += 3) {
    drag.step(twist(degrees), [](double ms) { return ms == 0.0; });
    EXPECT_LE(pose.last_result.iterations, degrees == 0 ? 1 : 0);
  }
  EXPECT_LT(off(pose, 60.0), 2e-3);
}

// Once for all that there might be time for, for what smooths the surface itself, for one iteration
// of the coarse one, and before smoothing; with time, before each of four iterations and smoothing.
TEST_F(DraggedFineCylinder, AsksForTimeBeforeWhatAFrameCanDoWithout) {
  DragSession drag = prepared_drag();
  for (int degrees = 0; degrees <= 12; degrees += 3) {
    drag.step(twist(degrees), [](double ms) { return ms == 0.0; });
  }
  const auto asks = [&](double degrees, int most) {
    int count = 0;
    drag.step(twist(degrees), [&](double) { return ++count <= most; });
    return count;
  };
  EXPECT_EQ(asks(15.0, 0), 4);
  EXPECT_EQ(asks(18.0, 4), 5);
}

TEST_F(DraggedFineCylinder, HandleAndBeltGoAsTheyAreHeld) {
  DragSession drag = prepared_drag();
  const DragState& pose = drag.state();
  for (int degrees = 0; degrees <= 30; degrees += 3) {
    drag.step(twist(degrees), [](double ms) { return ms == 0.0; });
  }
  for (const Index v : solver_->region().handles[0]) {
    const Vector3d wanted = twist(30.0)[0] * mesh_.positions[v];
    EXPECT_LT((mesh_.positions[v] + pose.displacement[v] - wanted).norm(), 1e-2);
  }
  for (const Index v : solver_->region().belt) EXPECT_LT(pose.displacement[v].norm(), 1e-2);
}

TEST_F(DraggedFineCylinder, EndsWhereSettlingDoes) {
  DragSession drag = prepared_drag();
  const DragState& pose = drag.state();
  for (int degrees = 0; degrees <= 30; degrees += 3) {
    int left = 1;
    drag.step(twist(degrees), [&left](double) { return left-- > 0; });
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
    drag.step(twist(degrees), [](double ms) { return ms == 0.0; });
    EXPECT_LE(pose.last_result.iterations, 1);
  }
  settle(drag, 60.0);
  EXPECT_LT(off(pose, 60.0), 1e-3);
}

TEST_F(DraggedFineCylinder, IsLeftWhileTheCoarseSurfaceIsMade) {
  for (int run = 0; run < 3; ++run) {
    DragSession drag(other_solver());
    for (int frame = 0; frame < 2 + run; ++frame) {
      drag.step(twist(3.0 * frame), [](double ms) { return ms == 0.0; });
    }
    EXPECT_LT(off(drag.state(), 3.0 * (1 + run)), 0.1);
  }
}

TEST_F(DraggedFineCylinder, MakingTheCoarseSurfaceCanBeCancelled) {
  DragSession drag(other_solver());
  EXPECT_THROW(drag.wait_until_prepared([](std::string_view, double) { return false; }), Cancelled);
  drag.wait_until_prepared();
}

TEST_F(DraggedFineCylinder, IsLeftWhileWhatItNeedsIsMade) {
  for (int run = 0; run < 3; ++run) {
    DragSession drag(other_solver());
    drag.prepare();
    drag.prepare();
    if (run == 0) continue;
    drag.step(twist(3.0));
    EXPECT_LT(off(drag.state(), 3.0), 1e-3);
  }
}

TEST_F(DraggedFineCylinder, LendsItsMemoryToTheSolverAndGoesOn) {
  DragSession drag = prepared_drag();
  const auto no_time = [](double ms) { return ms == 0.0; };
  for (int degrees = 0; degrees <= 15; degrees += 3) drag.step(twist(degrees), no_time);
  drag.release_memory();
  const DeformResult kept = solver_->solve_from(drag.state(), turned(15.0));
  EXPECT_TRUE(kept.certificate.settled);
  for (int degrees = 18; degrees <= 30; degrees += 3) drag.step(twist(degrees), no_time);
  settle(drag, 30.0);
  EXPECT_LT(off(drag.state(), 30.0), 1e-3);
}

// By the steps of the frames before alone it takes 17 iterations.
TEST_F(DraggedFineCylinder, SettlesAtRestByTheTangentOfItsPose) {
  DragSession drag = prepared_drag();
  const DragState& pose = drag.state();
  for (int degrees = 0; degrees <= 60; degrees += 3) {
    drag.step(twist(degrees), [](double ms) { return ms == 0.0; });
  }
  int iterations = 0;
  for (int frame = 0; frame < 100 && !pose.last_result.settled; ++frame) {
    int left = 3;
    drag.step(twist(60.0), [&left](double) { return left-- > 0; });
    EXPECT_LE(pose.last_result.iterations, 3);
    iterations += pose.last_result.iterations;
  }
  EXPECT_TRUE(pose.last_result.settled);
  EXPECT_LT(iterations, 12);
  EXPECT_LT(off(pose, 60.0), 1e-3);
}

TEST_F(DraggedFineCylinder, MovesOnWhereItWasSettlingAtRest) {
  const auto no_time = [](double ms) { return ms == 0.0; };
  DragSession drag = prepared_drag();
  const DragState& pose = drag.state();
  for (int degrees = 0; degrees <= 30; degrees += 3) {
    drag.step(twist(degrees), no_time);
  }
  for (int frame = 0; frame < 6; ++frame) drag.step(twist(30.0), no_time);
  EXPECT_FALSE(pose.last_result.settled);
  for (int degrees = 33; degrees <= 45; degrees += 3) {
    drag.step(twist(degrees), no_time);
  }
  EXPECT_LT(off(pose, 45.0), 2e-3);
  // The tangent of where it rested before would be of little use here.
  int frames = 0;
  for (; frames < 100 && !pose.last_result.settled; ++frames) {
    drag.step(twist(45.0), no_time);
  }
  EXPECT_LT(frames, 12);
  EXPECT_LT(off(pose, 45.0), 1e-3);
}

TEST_F(DraggedFineCylinder, ADragDoesNotDependOnTheOneBefore) {
  DragSession drag = prepared_drag();
  const auto dragged_by = [&](double degrees) {
    drag.begin();
    for (int frame = 1; frame <= 4; ++frame) {
      int left = 2;
      drag.step(twist(degrees * frame), [&left](double) { return left-- > 0; });
    }
    return drag.state();
  };
  const DragState first = dragged_by(5.0);
  dragged_by(-12.0);
  EXPECT_TRUE(same(dragged_by(5.0), first));
}

TEST_F(DraggedFineCylinder, GoesOnFromAPoseOfBefore) {
  DragSession drag = prepared_drag();
  const auto step = [&](double degrees) {
    int left = 2;
    drag.step(twist(degrees), [&left](double) { return left-- > 0; });
  };
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
  for (int degrees = 0; degrees <= 12; degrees += 3) {
    drag.step(twist(degrees), [](double ms) { return ms == 0.0; });
  }
  DragSession other(other_solver());
  other.begin(drag.state());
  settle(other, 12.0);
  EXPECT_LT(off(other.state(), 12.0), 1e-3);
}

TEST_F(DraggedFineCylinder, CancellingLeavesThePoseAsItWas) {
  DragSession drag = prepared_drag();
  cancel_a_frame_between(10.0, 20.0, drag);
  EXPECT_LT(off(drag.step(twist(20.0)), 20.0), 1e-3);
}

// A second step, on what the first one made.
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
  const auto linear = std::make_shared<const DeformSolver>(
      mesh_.positions, topology_, test::ends_of_cylinder(mesh_), test::linear_options(), kernels_);
  EXPECT_THAT(error_message<InputError>([&] { DragSession drag(linear); }),
              ::testing::HasSubstr("\"settle\" in the deform options"));
}

}  // namespace
}  // namespace lapwing
