#include "lapwing/coating/transition.h"

#include <gtest/gtest.h>

#include "coating/coating_scenes.h"
#include "lapwing/region/geodesic.h"

namespace lapwing::test {
namespace {

TEST(Transition, GoesFromNothingToAllOverItsWidth) {
  for (const auto profile : {Transition::Profile::smooth, Transition::Profile::linear}) {
    const Transition transition{2.0, profile};
    EXPECT_EQ(fade(transition, 0.0), 0.0);
    EXPECT_EQ(fade(transition, 1.0), 0.5);
    EXPECT_EQ(fade(transition, 2.0), 1.0);
    EXPECT_EQ(fade(transition, kNoLimit), 1.0);
    for (double x = 0.0; x < 2.0; x += 0.1) {
      EXPECT_LT(fade(transition, x), fade(transition, x + 0.1));
    }
  }
}

TEST(Transition, SmoothHasNoKinkAndLinearIsStraight) {
  const Transition smooth{1.0, Transition::Profile::smooth};
  EXPECT_LT(fade(smooth, 0.01) / 0.01, 0.04);
  EXPECT_LT((1.0 - fade(smooth, 0.99)) / 0.01, 0.04);
  EXPECT_DOUBLE_EQ(fade({1.0, Transition::Profile::linear}, 0.3), 0.3);
}

TEST(Transition, WithoutAWidthIsAllThereEverywhere) {
  EXPECT_EQ(fade({}, 0.0), 1.0);
  const PatchedMesh square(grid(6, 6));
  const auto shares = fades({}, square.patch, square.topology, square.mesh.positions);
  EXPECT_EQ(shares, std::vector<double>(49, 1.0));
}

TEST(Transition, IsMeasuredFromThePatchsBorder) {
  const PatchedMesh square(grid(20, 20));
  const Transition transition{0.25, Transition::Profile::linear};
  const auto shares = fades(transition, square.patch, square.topology, square.mesh.positions);
  for (std::size_t own = 0; own < shares.size(); ++own) {
    const Eigen::Vector3d& p = square.mesh.positions[square.patch.vertices[own]];
    const double depth = std::min({p.x(), 1.0 - p.x(), p.y(), 1.0 - p.y()});
    EXPECT_NEAR(shares[own], std::min(1.0, depth / 0.25), 0.03);
  }
}

}  // namespace
}  // namespace lapwing::test
