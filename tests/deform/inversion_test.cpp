#include "lapwing/deform/inversion.h"

#include <numeric>

#include <Eigen/Geometry>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "lapwing/deform/certificate_warnings.h"
#include "lapwing/mesh/shapes.h"

namespace lapwing {
namespace {

using Eigen::Vector3d;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

std::vector<Index> all_of(const Mesh& mesh) {
  std::vector<Index> all(mesh.vertex_count());
  std::iota(all.begin(), all.end(), Index{0});
  return all;
}

Inversion inversion_of(const Mesh& mesh, const Positions& current) {
  return measure_inversion(all_of(mesh), mesh.topology(), mesh.positions, current);
}

// A tube along z from 0 to 6 whose surface is turned into itself from z = 3 on: what was outside
// is inside there, as of a sleeve that is half pulled through.
Positions pulled_through(const Mesh& tube) {
  Positions positions = tube.positions;
  for (Vector3d& p : positions) {
    if (p.z() <= 3.0) continue;
    p = {0.7 * p.x(), 0.7 * p.y(), 6.0 - p.z()};
  }
  return positions;
}

TEST(Inversion, IsNoneOfAMotionThatIsRigidOrStretches) {
  const Mesh ball = icosphere(3);
  EXPECT_EQ(inversion_of(ball, ball.positions).share, 0.0);
  const Eigen::Affine3d motion = Eigen::Translation3d(3.0, 2.0, 1.0) *
                                 Eigen::AngleAxisd(2.5, Vector3d(1.0, 2.0, 0.0).normalized()) *
                                 Eigen::Scaling(2.0, 0.3, 1.0);
  Positions moved = ball.positions;
  for (Vector3d& p : moved) p = motion * p;
  EXPECT_EQ(inversion_of(ball, moved).share, 0.0);
}

TEST(Inversion, IsAllOfAMirrorImage) {
  const Mesh ball = icosphere(3);
  Positions mirrored = ball.positions;
  for (Vector3d& p : mirrored) p.z() = -p.z();
  EXPECT_EQ(inversion_of(ball, mirrored).share, 1.0);
}

TEST(Inversion, IsNoneOfASheetThatHasNoOppositeSide) {
  const Mesh sheet = grid(10, 10);
  Positions mirrored = sheet.positions;
  for (Vector3d& p : mirrored) p.x() = -p.x();
  EXPECT_EQ(inversion_of(sheet, mirrored).share, 0.0);
}

TEST(Inversion, TellsASleeveThatIsHalfPulledThrough) {
  const Mesh tube = rippled_cylinder(40, 81);
  const Inversion inversion = inversion_of(tube, pulled_through(tube));
  EXPECT_NEAR(inversion.share, 0.5, 0.05);
  ASSERT_NE(inversion.vertex, kNoIndex);
  EXPECT_GT(tube.positions[inversion.vertex].z(), 3.0);
}

TEST(Inversion, IsWarnedOfWithTheAdviceThatTheRegionAllows) {
  const Mesh tube = rippled_cylinder(40, 81);
  const auto warned = [&](const std::vector<Index>& roi) {
    Certificate certificate;
    measure_shape(roi, tube.topology(), tube.positions, pulled_through(tube), certificate);
    certificate.largest_edge_stretch = 0.0;
    return warnings_of(certificate);
  };
  EXPECT_THAT(warned(all_of(tube)),
              ElementsAre(::testing::AllOf(HasSubstr("50% of the region is inside out"),
                                           ::testing::Not(HasSubstr("enlarge the region")))));
  std::vector<Index> upper;
  for (Index v = 0; v < tube.vertex_count(); ++v) {
    if (tube.positions[v].z() > 1.0) upper.push_back(v);
  }
  EXPECT_THAT(warned(upper), ElementsAre(HasSubstr("or enlarge the region")));
}

}  // namespace
}  // namespace lapwing
