#include "lapwing/coating/patch_fades.h"

#include <gtest/gtest.h>

#include "coating/coating_scenes.h"

namespace lapwing::test {
namespace {

TEST(PatchFades, WithoutAWidthAreAllThereEverywhere) {
  const PatchedMesh square(grid(6, 6));
  const auto shares = fades({}, square.patch, square.topology, square.mesh.positions);
  EXPECT_EQ(shares, std::vector<double>(49, 1.0));
}

TEST(PatchFades, AreMeasuredFromThePatchsBorder) {
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
