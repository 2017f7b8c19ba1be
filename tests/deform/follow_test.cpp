#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "lapwing/base/errors.h"
#include "lapwing/deform/deformer.h"
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

bool same(const SettledPose& a, const SettledPose& b) {
  return a.parameters == b.parameters && a.displacement == b.displacement;
}

class FollowedCylinder : public ::testing::Test {
 protected:
  Positions positions(const SettledPose& pose) const {
    Positions positions = mesh_.positions;
    for (std::size_t v = 0; v < positions.size(); ++v) positions[v] += pose.displacement[v];
    return positions;
  }
  double distance_from_solution(const SettledPose& pose, double degrees) const {
    return largest_distance(positions(pose), deformer_.solve(turned(degrees)).positions);
  }

  Mesh mesh_ = test::rippled_cylinder(30, 61);
  Topology topology_ = mesh_.topology();
  CpuKernels kernels_;
  Deformer deformer_{mesh_.positions, topology_, test::ends_of_cylinder(mesh_), {}, kernels_};
};

TEST_F(FollowedCylinder, StillHandleKeepsTheRestPositions) {
  SettledPose pose;
  for (int frame = 0; frame < 3; ++frame) {
    deformer_.follow(twist(0.0), pose);
    EXPECT_LT(largest_distance(positions(pose), mesh_.positions), 1e-9);
  }
}

// Wound by -100 the distance is 0.8.
TEST_F(FollowedCylinder, TurnOf260DegreesInFramesKeepsItsWinding) {
  SettledPose pose;
  for (int degrees = 10; degrees <= 260; degrees += 10) {
    deformer_.follow(twist(degrees), pose);
    EXPECT_TRUE(pose.settled.settled) << degrees << " degrees";
  }
  EXPECT_NEAR(pose.motions.turns[0].angle() * 180.0 / std::numbers::pi, 260.0, 1e-6);
  EXPECT_LT(distance_from_solution(pose, 260.0), 1e-3);
}

TEST_F(FollowedCylinder, FirstFrameIsWoundByItsTurn) {
  for (const double degrees : {260.0, -100.0}) {
    SettledPose pose;
    deformer_.follow(turned(degrees), pose);
    EXPECT_LT(distance_from_solution(pose, degrees), 1e-3) << degrees << " degrees";
  }
}

TEST_F(FollowedCylinder, FramesFarApartEndWhereTheSolutionIs) {
  SettledPose pose;
  for (const double degrees : {120.0, 240.0, 30.0, -90.0}) {
    deformer_.follow(turned(degrees), pose);
    EXPECT_LT(distance_from_solution(pose, degrees), 1e-3) << degrees << " degrees";
  }
}

TEST_F(FollowedCylinder, ADragDoesNotDependOnTheOneBefore) {
  const auto drag = [&](double degrees) {
    SettledPose pose;
    for (int frame = 1; frame <= 4; ++frame) deformer_.follow(twist(degrees * frame), pose);
    return pose;
  };
  const SettledPose first = drag(5.0);
  drag(-12.0);
  EXPECT_TRUE(same(drag(5.0), first));
}

TEST_F(FollowedCylinder, CancellingLeavesThePoseAsItWas) {
  SettledPose pose;
  deformer_.follow(twist(10.0), pose);
  const SettledPose before = pose;
  int calls = 0;
  const auto third = [&calls](std::string_view, double) { return ++calls < 3; };
  EXPECT_THROW(deformer_.follow(twist(20.0), pose, {}, third), Cancelled);
  EXPECT_TRUE(same(pose, before));
  deformer_.follow(twist(20.0), pose);
  EXPECT_LT(distance_from_solution(pose, 20.0), 1e-3);
}

// Grabbing what has settled, and not moving it.
TEST_F(FollowedCylinder, TheSameMotionAgainMovesNothing) {
  SettledPose pose;
  deformer_.follow(twist(40.0), pose);
  ASSERT_TRUE(pose.settled.settled);
  const SettledPose before = pose;
  deformer_.follow(twist(40.0), pose);
  EXPECT_TRUE(same(pose, before));
}

TEST_F(FollowedCylinder, FramesWithoutTimeEndWhereSettlingDoes) {
  SettledPose pose;
  int frames = 0;
  do {
    int left = 3;
    deformer_.follow(twist(30.0), pose, [&left](double) { return left-- > 0; });
  } while (!pose.settled.settled && ++frames < 100);
  EXPECT_GT(frames, 1);
  EXPECT_LT(distance_from_solution(pose, 30.0), 1e-3);
}

// Of a frame that has no time at all: where it begins.
TEST_F(FollowedCylinder, AFrameBeginsNearWhereAHandleThatGoesOnTakesTheSurface) {
  const auto no_time = [](double) { return false; };
  SettledPose pose;
  for (double degrees = 0.0; degrees <= 40.0; degrees += 2.0) {
    deformer_.follow(twist(degrees), pose);
  }
  ASSERT_TRUE(pose.settled.settled);
  SettledPose alone = deformer_.response()->pose_at(positions(pose), turned(40.0));  // from nowhere
  deformer_.follow(twist(42.0), alone, no_time);
  SettledPose on = pose;
  deformer_.follow(twist(42.0), on, no_time);
  EXPECT_LT(3.0 * distance_from_solution(on, 42.0), distance_from_solution(alone, 42.0));
  // Back the linear response alone takes it.
  SettledPose back = pose;
  deformer_.follow(twist(38.0), back, no_time);
  EXPECT_LT(distance_from_solution(back, 38.0), 1.5 * distance_from_solution(alone, 42.0));
}

TEST_F(FollowedCylinder, ADragFromAPoseBeginsThere) {
  const DeformResult settled = deformer_.solve(turned(40.0));
  const auto pose = std::make_shared<const SettledPose>(
      deformer_.response()->pose_at(settled.positions, turned(40.0)));
  const auto dragged_to = [&](double degrees) {
    return test::dragged(deformer_.response(), twist(degrees), pose);
  };
  EXPECT_LT(largest_distance(dragged_to(40.0), settled.positions), 1e-12);
  const double moved = largest_distance(dragged_to(41.0), settled.positions);
  EXPECT_GT(moved, 1e-3);
  EXPECT_LT(moved, 2e-2);
}

// Of 7,260 vertices, which a coarse surface takes along.
// A deformer writes its next frame into the memory of the pose before the last.
TEST_F(FollowedCylinder, FramesAreTheSameWhereTheirPosesAreKept) {
  const Deformer other(mesh_.positions, topology_, test::ends_of_cylinder(mesh_), {}, kernels_);
  SettledPose in_place;
  std::vector<SettledPose> kept(1);
  for (const double degrees : {10.0, 25.0, 30.0, 30.0, 20.0, 0.0}) {
    deformer_.follow(twist(degrees), in_place);
    SettledPose next = kept.back();
    other.follow(twist(degrees), next);
    EXPECT_TRUE(same(in_place, next)) << degrees << " degrees";
    kept.push_back(std::move(next));
  }
  SettledPose again;
  for (std::size_t k = 0; k < 3; ++k) {
    other.follow(twist(std::array{10.0, 25.0, 30.0}[k]), again);
    EXPECT_TRUE(same(again, kept[k + 1]));
  }
}

TEST_F(FollowedCylinder, APoseOfALargerRegionLeavesNothingOutsideOfASmallerOne) {
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
  const Deformer small(mesh_.positions, topology_, lower, {}, kernels_);
  SettledPose pose;
  deformer_.follow(twist(20.0), pose);
  deformer_.follow(twist(25.0), pose);
  for (const double degrees : {30.0, 35.0, 40.0}) {
    small.follow(twist(degrees), pose);
    for (Index v = 0; v < mesh_.vertex_count(); ++v) {
      const bool is_inside = std::binary_search(lower.roi.begin(), lower.roi.end(), v);
      EXPECT_TRUE(is_inside || pose.displacement[v].isZero(0.0)) << v;
    }
  }
}

class FollowedFineCylinder : public ::testing::Test {
 protected:
  void SetUp() override { deformer_.prepare_to_follow(); }

  // By three iterations a frame.
  static void settle(const Deformer& deformer, double degrees, SettledPose& pose) {
    for (int frame = 0; frame < 400 && !pose.settled.settled; ++frame) {
      int left = 3;
      deformer.follow(twist(degrees), pose, [&left](double) { return left-- > 0; });
    }
    EXPECT_TRUE(pose.settled.settled);
  }
  double off(const SettledPose& pose, double degrees) const {
    const Positions solved = deformer_.solve(turned(degrees)).positions;
    double most = 0.0;
    for (std::size_t v = 0; v < solved.size(); ++v) {
      most = std::max(most, (mesh_.positions[v] + pose.displacement[v] - solved[v]).norm());
    }
    return most / kDiagonal;
  }

  static constexpr double kDiagonal = 6.2;
  Mesh mesh_ = test::rippled_cylinder();
  CpuKernels kernels_;
  Deformer deformer_{
      mesh_.positions, mesh_.topology(), test::ends_of_cylinder(mesh_), {}, kernels_};
};

// Of one frame at rest before, whose iteration tells how long one takes, and of frames that have
// time for the coarse surface alone, from the first that moves.
TEST_F(FollowedFineCylinder, FramesThatOnlyTakeItAlongStayNearTheSolution) {
  SettledPose pose;
  for (int degrees = 0; degrees <= 60; degrees += 3) {
    deformer_.follow(twist(degrees), pose, [](double ms) { return ms == 0.0; });
    EXPECT_LE(pose.settled.iterations, degrees == 0 ? 1 : 0);
  }
  EXPECT_LT(off(pose, 60.0), 2e-3);
}

// Once for all that there might be time for, for what smooths the surface itself, for one iteration
// of the coarse one, and before smoothing; with time, before each of four iterations and smoothing.
TEST_F(FollowedFineCylinder, AsksForTimeBeforeWhatAFrameCanDoWithout) {
  SettledPose pose;
  for (int degrees = 0; degrees <= 12; degrees += 3) {
    deformer_.follow(twist(degrees), pose, [](double ms) { return ms == 0.0; });
  }
  const auto asks = [&](double degrees, int most) {
    int count = 0;
    deformer_.follow(twist(degrees), pose, [&](double) { return ++count <= most; });
    return count;
  };
  EXPECT_EQ(asks(15.0, 0), 4);
  EXPECT_EQ(asks(18.0, 4), 5);
}

TEST_F(FollowedFineCylinder, HandleAndBeltGoAsTheyAreHeld) {
  SettledPose pose;
  for (int degrees = 0; degrees <= 30; degrees += 3) {
    deformer_.follow(twist(degrees), pose, [](double ms) { return ms == 0.0; });
  }
  for (const Index v : deformer_.region().handles[0]) {
    const Vector3d wanted = twist(30.0)[0] * mesh_.positions[v];
    EXPECT_LT((mesh_.positions[v] + pose.displacement[v] - wanted).norm(), 1e-2);
  }
  for (const Index v : deformer_.region().belt) EXPECT_LT(pose.displacement[v].norm(), 1e-2);
}

TEST_F(FollowedFineCylinder, EndsWhereSettlingDoes) {
  SettledPose pose;
  for (int degrees = 0; degrees <= 30; degrees += 3) {
    int left = 1;
    deformer_.follow(twist(degrees), pose, [&left](double) { return left-- > 0; });
  }
  settle(deformer_, 30.0, pose);
  EXPECT_LT(off(pose, 30.0), 1e-3);
  const SettledPose before = pose;
  deformer_.follow(twist(30.0), pose);
  EXPECT_TRUE(same(pose, before));
}

TEST_F(FollowedFineCylinder, FramesGoOnWhileTheCoarseSurfaceIsMade) {
  const Deformer unprepared(mesh_.positions, mesh_.topology(), test::ends_of_cylinder(mesh_), {},
                            kernels_);
  SettledPose pose;
  for (int degrees = 0; degrees <= 60; degrees += 3) {
    unprepared.follow(twist(degrees), pose, [](double ms) { return ms == 0.0; });
    EXPECT_LE(pose.settled.iterations, 1);
  }
  settle(unprepared, 60.0, pose);
  EXPECT_LT(off(pose, 60.0), 1e-3);
}

TEST_F(FollowedFineCylinder, IsLeftWhileTheCoarseSurfaceIsMade) {
  SettledPose pose;
  for (int run = 0; run < 3; ++run) {
    const Deformer unprepared(mesh_.positions, mesh_.topology(), test::ends_of_cylinder(mesh_), {},
                              kernels_);
    pose = {};
    for (int frame = 0; frame < 2 + run; ++frame) {
      unprepared.follow(twist(3.0 * frame), pose, [](double ms) { return ms == 0.0; });
    }
  }
  EXPECT_LT(off(pose, 9.0), 0.1);
}

TEST_F(FollowedFineCylinder, MakingTheCoarseSurfaceCanBeCancelled) {
  const Deformer unprepared(mesh_.positions, mesh_.topology(), test::ends_of_cylinder(mesh_), {},
                            kernels_);
  EXPECT_THROW(unprepared.prepare_to_follow([](std::string_view, double) { return false; }),
               Cancelled);
  // With the coarse surface there, what is waited for next.
  EXPECT_THROW(unprepared.prepare_to_follow(
                   [](std::string_view, double fraction) { return fraction < 1.0; }),
               Cancelled);
  unprepared.prepare_to_follow();
}

TEST_F(FollowedFineCylinder, IsLeftWhileWhatItNeedsIsMade) {
  for (int run = 0; run < 3; ++run) {
    const Deformer left(mesh_.positions, mesh_.topology(), test::ends_of_cylinder(mesh_), {},
                        kernels_);
    left.begin_to_follow();
    left.begin_to_follow();
    if (run == 0) continue;
    SettledPose pose;
    left.follow(twist(3.0), pose);
    EXPECT_LT(off(pose, 3.0), 1e-3);
  }
}

// By the steps of the frames before alone it takes 17 iterations.
TEST_F(FollowedFineCylinder, SettlesAtRestByTheTangentOfItsPose) {
  SettledPose pose;
  for (int degrees = 0; degrees <= 60; degrees += 3) {
    deformer_.follow(twist(degrees), pose, [](double ms) { return ms == 0.0; });
  }
  int iterations = 0;
  for (int frame = 0; frame < 100 && !pose.settled.settled; ++frame) {
    int left = 3;
    deformer_.follow(twist(60.0), pose, [&left](double) { return left-- > 0; });
    EXPECT_LE(pose.settled.iterations, 3);
    iterations += pose.settled.iterations;
  }
  EXPECT_TRUE(pose.settled.settled);
  EXPECT_LT(iterations, 12);
  EXPECT_LT(off(pose, 60.0), 1e-3);
}

TEST_F(FollowedFineCylinder, MovesOnWhereItWasSettlingAtRest) {
  const auto no_time = [](double ms) { return ms == 0.0; };
  SettledPose pose;
  for (int degrees = 0; degrees <= 30; degrees += 3) {
    deformer_.follow(twist(degrees), pose, no_time);
  }
  for (int frame = 0; frame < 6; ++frame) deformer_.follow(twist(30.0), pose, no_time);
  EXPECT_FALSE(pose.settled.settled);
  for (int degrees = 33; degrees <= 45; degrees += 3) {
    deformer_.follow(twist(degrees), pose, no_time);
  }
  EXPECT_LT(off(pose, 45.0), 2e-3);
  // The tangent of where it rested before would be of little use here.
  int frames = 0;
  for (; frames < 100 && !pose.settled.settled; ++frames) {
    deformer_.follow(twist(45.0), pose, no_time);
  }
  EXPECT_LT(frames, 12);
  EXPECT_LT(off(pose, 45.0), 1e-3);
}

TEST_F(FollowedFineCylinder, ADragDoesNotDependOnTheOneBefore) {
  const auto drag = [&](double degrees) {
    SettledPose pose;
    for (int frame = 1; frame <= 4; ++frame) {
      int left = 2;
      deformer_.follow(twist(degrees * frame), pose, [&left](double) { return left-- > 0; });
    }
    return pose;
  };
  const SettledPose first = drag(5.0);
  drag(-12.0);
  EXPECT_TRUE(same(drag(5.0), first));
}

TEST_F(FollowedFineCylinder, GoesOnFromAPoseOfBefore) {
  const auto one_more = [](int& left) { return [&left](double) { return left-- > 0; }; };
  SettledPose pose;
  for (int degrees = 0; degrees <= 12; degrees += 3) {
    int left = 2;
    deformer_.follow(twist(degrees), pose, one_more(left));
  }
  SettledPose on = pose;
  SettledPose again = pose;
  int left = 2;
  deformer_.follow(twist(15.0), on, one_more(left));
  left = 2;
  deformer_.follow(twist(15.0), again, one_more(left));
  EXPECT_LT(off(on, 15.0), 0.01);
  EXPECT_LT(off(again, 15.0), 0.01);
}

TEST_F(FollowedFineCylinder, GoesOnAtRestFromAPoseOfAnotherDeformer) {
  SettledPose pose;
  for (int degrees = 0; degrees <= 12; degrees += 3) {
    deformer_.follow(twist(degrees), pose, [](double ms) { return ms == 0.0; });
  }
  const Deformer other(mesh_.positions, mesh_.topology(), test::ends_of_cylinder(mesh_), {},
                       kernels_);
  settle(other, 12.0, pose);
  EXPECT_LT(off(pose, 12.0), 1e-3);
}

TEST_F(FollowedFineCylinder, CancellingLeavesThePoseAsItWas) {
  SettledPose pose;
  deformer_.follow(twist(10.0), pose);
  const SettledPose before = pose;
  int calls = 0;
  const auto third = [&calls](std::string_view, double) { return ++calls < 3; };
  EXPECT_THROW(deformer_.follow(twist(20.0), pose, {}, third), Cancelled);
  EXPECT_TRUE(same(pose, before));
  deformer_.follow(twist(20.0), pose);
  EXPECT_LT(off(pose, 20.0), 1e-3);
}

// A second step, on what the first one made.
TEST(Follow, TwoStepsOf130DegreesTurnTheMiddleBy130) {
  const Mesh mesh = test::rippled_cylinder();
  const Topology& topology = mesh.topology();
  CpuKernels kernels;
  const Positions& start = mesh.positions;
  Positions rest = start;
  for (int step = 0; step < 2; ++step) {
    const Deformer deformer(rest, topology, test::ends_of_cylinder(mesh), {}, kernels);
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

TEST_F(FollowedCylinder, MotionThatIsNotFiniteLeavesThePoseAsItWas) {
  SettledPose pose;
  deformer_.follow(twist(10.0), pose);
  const SettledPose before = pose;
  std::array motions = twist(10.0);
  motions[0].translation().x() = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(deformer_.follow(motions, pose), SolverError);
  EXPECT_TRUE(same(pose, before));
}

TEST_F(FollowedCylinder, WrongNumberOfMotionsIsRefused) {
  SettledPose pose;
  EXPECT_THROW(deformer_.follow(HandleMotions(), pose), InputError);
  deformer_.follow(twist(10.0), pose);
  const std::vector<Affine3d> two(2, twist(10.0)[0]);
  EXPECT_THROW(deformer_.follow(two, pose), InputError);
}

TEST_F(FollowedCylinder, WithoutSettlingInTheOptionsADragCannotBeFollowed) {
  const Deformer linear(mesh_.positions, topology_, test::ends_of_cylinder(mesh_),
                        test::linear_options(), kernels_);
  SettledPose pose;
  EXPECT_THAT(error_message<InputError>([&] { linear.follow(twist(10.0), pose); }),
              ::testing::HasSubstr("settling in the deform options"));
}

}  // namespace
}  // namespace lapwing
