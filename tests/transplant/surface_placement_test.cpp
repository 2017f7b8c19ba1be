#include "lapwing/transplant/surface_placement.h"

#include <limits>

#include <gmock/gmock.h>

#include "lapwing/base/errors.h"
#include "lapwing/mesh/shapes.h"
#include "lapwing/transplant/cut.h"
#include "lapwing/transplant/loop_curve.h"
#include "support/error_message.h"
#include "transplant/loops.h"

namespace lapwing {
namespace {

using Eigen::Affine3d;
using Eigen::Vector3d;
using test::circle_points;
using test::difference;
using test::first_loop;
using test::moved;
using test::similarity;
using Points = std::vector<Vector3d>;

const Affine3d kIdentity = Affine3d::Identity();

TEST(PlaceAt, LoopComesToThePointAndStandsAlongTheNormal) {
  const auto part = moved(similarity(70.0, {1, 2, 0}, 0.5, {3, 1, 4}), circle_points(20));
  const SurfacePlace place{{1, 2, 3}, {0, -2, 1}};
  const Affine3d placed = place_at(kIdentity, part, place, "place");
  const LoopFrame frame = loop_frame(LoopCurve(moved(placed, part), "loop"));
  EXPECT_LT((frame.center - place.point).norm(), 1e-12);
  EXPECT_LT((frame.normal - place.normal.normalized()).norm(), 1e-12);
  EXPECT_NEAR(placed.linear().determinant(), 1.0, 1e-12);
}

TEST(PlaceAt, PartThatStandsThereStays) {
  const Affine3d placement = similarity(33.0, {0, 0, 1}, 2.0, {1, 1, 0});
  const Affine3d placed = place_at(placement, circle_points(20), {{1, 1, 0}, {0, 0, 5}}, "place");
  EXPECT_LT(difference(placed, placement), 1e-12);
}

TEST(PlaceAt, TurnsNoMoreThanTheNormalsDo) {
  const SurfacePlace place{{0, 0, 0}, {0, std::sin(0.3), std::cos(0.3)}};
  const Affine3d placed = place_at(kIdentity, circle_points(20), place, "place");
  const Eigen::AngleAxisd turn(placed.linear());
  EXPECT_NEAR(turn.angle(), 0.3, 1e-12);
  EXPECT_NEAR(std::abs(turn.axis().x()), 1.0, 1e-12);
}

TEST(PlaceAt, StandsOnItsHeadWhereTheNormalPointsDown) {
  const Affine3d placed = place_at(kIdentity, circle_points(20), {{0, 0, 0}, {0, 0, -1}}, "place");
  EXPECT_NEAR(placed.linear().determinant(), 1.0, 1e-12);
  EXPECT_LT((placed.linear() * Vector3d::UnitZ() + Vector3d::UnitZ()).norm(), 1e-12);
}

TEST(PlaceAt, TurnAndScaleComeOnTop) {
  const Affine3d placement = similarity(10.0, {0, 0, 1}, 2.0, {0, 0, 0});
  const Affine3d placed =
      place_at(placement, circle_points(20), {{0, 0, 1}, {0, 0, 1}, 25.0, 3.0}, "place");
  EXPECT_LT(difference(placed, similarity(35.0, {0, 0, 1}, 6.0, {0, 0, 1})), 1e-12);
}

TEST(PlaceAt, WhatIsNoPlaceIsRefused) {
  const auto refused = [](const SurfacePlace& place) {
    return error_message<InputError>(
        [&] { place_at(kIdentity, circle_points(20), place, "here"); });
  };
  EXPECT_THAT(refused({{0, 0, 0}, {0, 0, 0}}), testing::HasSubstr("here: "));
  EXPECT_NE(refused({{std::numeric_limits<double>::quiet_NaN(), 0, 0}, {0, 0, 1}}), "");
  EXPECT_THAT(refused({{0, 0, 0}, {0, 0, 1}, 0.0, -1.0}), testing::HasSubstr("above 0"));
}

Points small_circle() {
  return moved(similarity(0, {0, 0, 1}, 0.2, {0.4, 0.6, 0}), circle_points(30));
}

SurfaceSnap snap_to(const Mesh& mesh) {
  return {mesh.topology().triangles, mesh.positions, "mesh"};
}

TEST(SurfaceSnap, LoopOnTheSurfaceStays) {
  const Affine3d snapped = snap_to(grid(8, 8)).snap(Affine3d::Identity(), small_circle(), "part");
  EXPECT_LT(difference(snapped, Affine3d::Identity()), 1e-9);
}

TEST(SurfaceSnap, OnAPlaneThePartMovesAlongTheNormalAndTiltsWithoutSpinning) {
  const Affine3d placement = similarity(12.0, {1, 1, 0}, 1.0, {0.02, -0.05, 0.3});
  const Points part = small_circle();
  const Affine3d snapped = snap_to(grid(8, 8)).snap(placement, part, "part");
  for (const Vector3d& p : part) EXPECT_NEAR((snapped * p).z(), 0.0, 1e-9);
  const Affine3d change = snapped * placement.inverse();
  EXPECT_NEAR(Eigen::AngleAxisd(change.linear()).angle(), 12.0 * std::numbers::pi / 180.0, 1e-6);
  EXPECT_NEAR(Eigen::AngleAxisd(change.linear()).axis().z(), 0.0, 1e-6);
  const Vector3d center = placement * Vector3d(0.4, 0.6, 0.0);
  EXPECT_LT((change * center - center).head<2>().norm(), 1e-6);
}

struct SnapToASphere : testing::Test {
  Mesh sphere = icosphere(4);
  Points part = [this] {
    VertexSet cap;
    for (Index v = 0; v < sphere.vertex_count(); ++v) {
      if (sphere.positions[v].z() > 0.8) cap.push_back(v);
    }
    return first_loop(cut_out(sphere, cap, "cap").mesh);
  }();
  Affine3d placement = similarity(15.0, {1, 0, 0}, 1.0, {0.1, 0.0, 0.3});
};

TEST_F(SnapToASphere, LoopOfACapComesBackOntoIt) {
  const Affine3d snapped = snap_to(sphere).snap(placement, part, "part");
  for (const Vector3d& p : part) EXPECT_NEAR((snapped * p).norm(), 1.0, 5e-3);
  EXPECT_LT((snapped.matrix() - placement.matrix()).norm(), 0.6) << "stays where it was put";
}

TEST_F(SnapToASphere, FollowsWhenEverythingMoves) {
  const Affine3d motion = similarity(100.0, {1, -2, 1}, 3.0, {5, 6, 7});
  const Affine3d snapped = snap_to(sphere).snap(placement, part, "part");
  sphere.positions = moved(motion, sphere.positions);
  const Affine3d follows = snap_to(sphere).snap(motion * placement, part, "part");
  for (const Vector3d& p : part) EXPECT_LT((follows * p - motion * (snapped * p)).norm(), 1e-4);
}

TEST(SurfaceSnap, LoopAcrossATubeStays) {
  const Mesh tube = cylinder(30, 21, 0.5, 3.0);
  VertexSet upper;
  for (Index v = 10 * 30; v < tube.vertex_count(); ++v) upper.push_back(v);
  const Points loop = first_loop(cut_out(tube, upper, "upper").mesh);
  ASSERT_LT(std::abs(loop[0].z() - 1.5), 1e-12);
  const Affine3d snapped = snap_to(tube).snap(Affine3d::Identity(), loop, "part");
  EXPECT_LT(difference(snapped, Affine3d::Identity()), 1e-9);
}

TEST(SurfaceSnap, ThinSheetIsNotTakenFromBehind) {
  Mesh sheet = grid(4, 4);
  const auto count = static_cast<Index>(sheet.vertex_count());
  const std::size_t faces = sheet.face_count();
  for (Index v = 0; v < count; ++v) {
    sheet.positions.push_back(sheet.positions[v] - 0.01 * Vector3d::UnitZ());
  }
  for (std::size_t f = 0; f < faces; ++f) {
    const auto face = sheet.face(f);
    sheet.add_face(std::array{face[2] + count, face[1] + count, face[0] + count});
  }
  const Affine3d low(Eigen::Translation3d(0.0, 0.0, -0.009));
  const Affine3d snapped = snap_to(sheet).snap(low, small_circle(), "part");
  EXPECT_LT(difference(snapped, Affine3d::Identity()), 1e-9);
}

TEST(SurfaceSnap, TrianglesThatAreNotFiniteDoNotCount) {
  Mesh sheet = grid(8, 8);
  sheet.positions[80].setConstant(std::numeric_limits<double>::quiet_NaN());
  const Affine3d lifted(Eigen::Translation3d(0.0, 0.0, 0.1));
  const Affine3d snapped = snap_to(sheet).snap(lifted, small_circle(), "part");
  EXPECT_LT(difference(snapped, Affine3d::Identity()), 1e-9);
  for (auto& p : sheet.positions) p.x() = std::numeric_limits<double>::infinity();
  EXPECT_NE(error_message<InputError>([&] { snap_to(sheet); }), "");
}

TEST(SurfaceSnap, MeshWithoutTrianglesIsNamed) {
  EXPECT_THAT(error_message<InputError>([] { snap_to(Mesh{}); }),
              testing::HasSubstr("mesh: the mesh has no triangles"));
}

}  // namespace
}  // namespace lapwing
