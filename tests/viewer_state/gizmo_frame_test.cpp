#include "tools/gizmo_frame.h"

#include <gtest/gtest.h>

#include "lapwing/mesh/shapes.h"
#include "viewer_state/tube_edit.h"

namespace lapwing::viewer::test {
namespace {

using Eigen::Affine3d;
using Eigen::Matrix3d;
using Eigen::Vector3d;

const Affine3d kRest = Affine3d::Identity();
const Affine3d kTurned =
    Eigen::Translation3d(1, 2, 3) * Eigen::AngleAxisd(0.7, Vector3d(1, 2, 2).normalized());

// A sheet in the plane of x and y, a strip along y its handle.
AppState sheet_with_strip() {
  AppState state = open_state(grid(20, 20));
  state = apply(std::move(state), Choose{kRoi, {AllVertices{}}});
  return apply(std::move(state), Choose{kHandle, {Box{{0.4, 0.2, -1.0}, {0.6, 0.9, 1.0}}}});
}

void expect_near(const Matrix3d& a, const Matrix3d& b) {
  EXPECT_LT((a - b).norm(), 1e-9) << a << " is not " << b;
}

TEST(GizmoAxes, OfTheWorldStayWhereverTheHandleGoes) {
  expect_near(gizmo_axes(GizmoAxes::world, sheet_with_strip(), 0, kTurned), Matrix3d::Identity());
}

TEST(GizmoAxes, OfTheHandleGoFromItsLongestExtentToItsShortestAndTurnWithIt) {
  const AppState state = sheet_with_strip();
  const Matrix3d axes = gizmo_axes(GizmoAxes::local, state, 0, kRest);
  EXPECT_NEAR(axes.col(0).y(), 1.0, 1e-9);
  EXPECT_NEAR(std::abs(axes.col(2).z()), 1.0, 1e-9);
  EXPECT_NEAR(axes.determinant(), 1.0, 1e-9);
  expect_near(gizmo_axes(GizmoAxes::local, state, 0, kTurned), kTurned.linear() * axes);
}

TEST(GizmoAxes, AtTheNormalHaveItAsTheirZ) {
  const AppState state = sheet_with_strip();
  const Matrix3d axes = gizmo_axes(GizmoAxes::normal, state, 0, kRest);
  EXPECT_NEAR(std::abs(axes.col(2).z()), 1.0, 1e-9);
  EXPECT_NEAR(axes.col(0).x(), 1.0, 1e-9);
  expect_near(gizmo_axes(GizmoAxes::normal, state, 0, kTurned), kTurned.linear() * axes);
}

TEST(GizmoAxes, OfAPinAndAClosedSurfaceAreTheWorlds) {
  AppState state = open_state(icosphere(2));
  state = apply(std::move(state), Choose{kRoi, {AllVertices{}}});
  const AppState pin = apply(state, Choose{kHandle, listed({7})});
  expect_near(gizmo_axes(GizmoAxes::local, pin, 0, kRest), Matrix3d::Identity());
  const AppState whole = apply(state, Choose{kHandle, {AllVertices{}}});
  expect_near(gizmo_axes(GizmoAxes::normal, whole, 0, kRest), Matrix3d::Identity());
}

TEST(GizmoCenter, GoesWithHandleAndRimAndStaysElsewhere) {
  const AppState state = chosen_tube();
  const auto center = [&](GizmoPivot pivot, const Affine3d& motion) {
    return gizmo_center({.pivot = pivot, .point = {4, 5, 6}}, state, 0, motion);
  };
  EXPECT_EQ(center(GizmoPivot::handle, kRest), handle_centroid(state, 0));
  // The head begins at z = 2.8.
  EXPECT_NEAR(center(GizmoPivot::rim, kRest).z(), 2.8, 0.2);
  EXPECT_LT(center(GizmoPivot::rim, kRest).z(), center(GizmoPivot::handle, kRest).z());
  for (const GizmoPivot goes : {GizmoPivot::handle, GizmoPivot::rim}) {
    EXPECT_LT((center(goes, kTurned) - kTurned * center(goes, kRest)).norm(), 1e-9);
  }
  // The belt is where the ROI begins, at z = 0.3.
  EXPECT_NEAR(center(GizmoPivot::belt, kRest).z(), 0.4, 0.2);
  EXPECT_EQ(center(GizmoPivot::point, kRest), Vector3d(4, 5, 6));
  EXPECT_EQ(center(GizmoPivot::origin, kRest), Vector3d::Zero());
  for (const GizmoPivot stays : {GizmoPivot::belt, GizmoPivot::point, GizmoPivot::origin}) {
    EXPECT_EQ(center(stays, kTurned), center(stays, kRest));
  }
}

}  // namespace
}  // namespace lapwing::viewer::test
