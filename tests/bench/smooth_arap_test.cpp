#include "studies/smooth_arap.h"

#include <array>
#include <numbers>

#include <gtest/gtest.h>

#include "lapwing/mesh/shapes.h"
#include "support/largest_distance.h"

namespace lapwing::bench {
namespace {

using Eigen::Affine3d;
using Eigen::AngleAxisd;
using Eigen::Vector3d;
using lapwing::test::largest_distance;

// A tube whose lower end is held and whose upper end is the handle. The parameter is lambda.
class SmoothArapOfATube : public ::testing::TestWithParam<double> {
 protected:
  SmoothArapOfATube() {
    const Bounds bounds = bounds_of(tube_.positions);
    region_.handles.resize(1);
    for (Index v = 0; v < tube_.vertex_count(); ++v) {
      const double height = (tube_.positions[v].z() - bounds.min.z()) / bounds.diagonal();
      region_.roi.push_back(v);
      if (height < 0.1) region_.belt.push_back(v);
      if (height > 0.8) region_.handles[0].push_back(v);
    }
  }

  const Mesh tube_ = rippled_cylinder(16, 25);
  EditRegion region_;
  const Affine3d bend_{Eigen::Translation3d(0.5, 0.0, 0.0) * AngleAxisd(0.5, Vector3d::UnitY())};
};

TEST_P(SmoothArapOfATube, StaysAtRestIfNothingMoves) {
  SmoothArap arap(tube_, region_, GetParam());
  arap.move(std::array{Affine3d::Identity()});
  arap.iterate(5, 0.0);
  EXPECT_LT(largest_distance(arap.positions(), tube_.positions), 1e-10);
  EXPECT_LT(arap.energy(), 1e-20);
}

TEST_P(SmoothArapOfATube, KeepsBeltAndHandleInPlaceAndLowersTheEnergy) {
  SmoothArap arap(tube_, region_, GetParam());
  arap.move(std::array{bend_});
  arap.iterate(1, 0.0);
  const double first = arap.energy();
  double before = first;
  for (int k = 0; k < 20; ++k) {
    arap.iterate(1, 0.0);
    // Rotations fitted to edges alone may raise the Laplacian term a little.
    ASSERT_LE(arap.energy(), before * (GetParam() > 0.0 ? 1.01 : 1.0 + 1e-12));
    before = arap.energy();
  }
  EXPECT_LT(before, 0.9 * first);
  const Positions positions = arap.positions();
  for (const Index v : region_.belt) EXPECT_EQ(positions[v], tube_.positions[v]);
  for (const Index v : region_.handles[0]) EXPECT_EQ(positions[v], bend_ * tube_.positions[v]);
}

TEST_P(SmoothArapOfATube, CommutesWithARotationOfEverything) {
  SmoothArap arap(tube_, region_, GetParam());
  arap.move(std::array{bend_});
  arap.iterate(40, 0.0);

  const Affine3d turn(AngleAxisd(0.5 * std::numbers::pi, Vector3d::UnitX()));
  Mesh turned = tube_;
  for (Vector3d& p : turned.positions) p = turn * p;
  SmoothArap of_turned(turned, region_, GetParam());
  of_turned.move(std::array{turn * bend_ * turn.inverse()});
  of_turned.iterate(40, 0.0);
  Positions back = of_turned.positions();
  for (Vector3d& p : back) p = turn.inverse() * p;
  EXPECT_LT(largest_distance(back, arap.positions()), 1e-8);
}

INSTANTIATE_TEST_SUITE_P(Lambdas, SmoothArapOfATube, ::testing::Values(0.0, 0.5, 0.9));

}  // namespace
}  // namespace lapwing::bench
