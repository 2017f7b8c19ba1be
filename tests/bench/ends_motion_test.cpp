#include "studies/real/ends_motion.h"

#include <cmath>
#include <limits>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "lapwing/base/errors.h"
#include "lapwing/mesh/shapes.h"

namespace lapwing::bench {
namespace {

using Eigen::Vector3d;
using ::testing::ElementsAre;

// 5 x 8 vertices, longest along y; row r holds vertices 5 r to 5 r + 4.
Positions long_grid() {
  Positions positions = grid(4, 7).positions;
  for (Vector3d& p : positions) p.y() *= 3.0;
  return positions;
}

TEST(EndsMotion, LiftMovesATenthAsideAlongTheAxisAfterTheLongest) {
  const Positions positions = long_grid();
  const MovedEnds ends = moved_ends(EndsMotion::lift, positions);
  EXPECT_THAT(ends.belt, ElementsAre(0, 1, 2, 3));
  EXPECT_THAT(ends.handle, ElementsAre(36, 37, 38, 39));
  EXPECT_TRUE(ends.map.linear().isIdentity());
  EXPECT_TRUE(ends.map.translation().isApprox(0.1 * std::sqrt(10.0) * Vector3d::UnitZ()));
}

TEST(EndsMotion, LiftGoesRoundFromZToX) {
  Positions positions = long_grid();
  for (Vector3d& p : positions) std::swap(p.y(), p.z());
  const MovedEnds ends = moved_ends(EndsMotion::lift, positions);
  EXPECT_TRUE(ends.map.translation().isApprox(0.1 * std::sqrt(10.0) * Vector3d::UnitX()));
}

TEST(EndsMotion, LeanTurnsTheTopAroundItsMeanAndMovesItInX) {
  const Positions positions = long_grid();
  const MovedEnds ends = moved_ends(EndsMotion::lean, positions);
  EXPECT_THAT(ends.belt, ElementsAre(0, 1, 2));
  EXPECT_THAT(ends.handle, ElementsAre(37, 38, 39));
  const Vector3d mean = positions[38];
  const Vector3d moved = mean + 0.2 * std::sqrt(10.0) * Vector3d::UnitX();
  EXPECT_TRUE((ends.map * mean).isApprox(moved));
  // Clockwise as seen from +z.
  const Vector3d right = positions[39] - mean;
  const Vector3d turned(std::sqrt(0.75) * right.norm(), -0.5 * right.norm(), 0.0);
  EXPECT_TRUE((ends.map * positions[39]).isApprox(moved + turned));
}

TEST(EndsMotion, HoldsThreeVerticesAtLeast) {
  const Positions positions = grid(3, 2).positions;
  EXPECT_EQ(moved_ends(EndsMotion::lean, positions).belt.size(), 3u);
  EXPECT_EQ(moved_ends(EndsMotion::lift, positions).handle.size(), 3u);
}

TEST(EndsMotion, RefusesWhatHasNoEnds) {
  Positions positions = grid(3, 2).positions;
  EXPECT_THROW(moved_ends(EndsMotion::lift, std::span(positions).first(5)), InputError);
  positions[4].y() = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(moved_ends(EndsMotion::lift, positions), InputError);
}

}  // namespace
}  // namespace lapwing::bench
