#include "lapwing/render/camera.h"

#include <array>
#include <cmath>
#include <numbers>

#include <Eigen/Geometry>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "lapwing/base/errors.h"
#include "lapwing/mesh/shapes.h"
#include "support/error_message.h"

namespace lapwing {
namespace {

using Eigen::Vector3d;

constexpr std::array kViews{View::three_quarter, View::front, View::back,  View::left,
                            View::right,         View::top,   View::bottom};

Vector3d to_clip(const Camera& camera, double aspect, const Vector3d& point) {
  const Eigen::Vector4d clip = camera.projection(aspect) * camera.view() * point.homogeneous();
  return clip.hnormalized();
}

class FitAnyView : public ::testing::TestWithParam<bool> {};

TEST_P(FitAnyView, ShowsAllPointsAsLargeAsTheMarginAllows) {
  Positions points = torus(24, 12, 2.0, 0.5).positions;
  for (Vector3d& p : points) p = Vector3d(p.x() + 1e4, 3.0 * p.y(), p.z() - 50.0);
  const Framing framing{.orthographic = GetParam(), .margin = 0.1};
  for (const View view : kViews) {
    for (const double aspect : {0.5, 1.0, 2.5}) {
      const Camera camera = fit(points, view_axes(view), aspect, framing);
      double largest = 0.0;
      for (const Vector3d& p : points) {
        const Vector3d clip = to_clip(camera, aspect, p);
        largest = std::max(largest, clip.head<2>().cwiseAbs().maxCoeff());
        EXPECT_GE(clip.z(), 0.0);
        EXPECT_LE(clip.z(), 1.0);
      }
      EXPECT_NEAR(largest, 1.0 - 2.0 * framing.margin, 1e-6);
    }
  }
}

TEST_P(FitAnyView, LeavesTheLegendItsPartAtTheRight) {
  const Positions points = torus(24, 12, 2.0, 0.5).positions;
  const Framing framing{.orthographic = GetParam(), .margin = 0.0, .legend = 0.25};
  const Camera camera = fit(points, view_axes(View::top), 0.5, framing);
  double left = 1.0;
  double right = -1.0;
  for (const Vector3d& p : points) {
    const double across = to_clip(camera, 0.5, p).x();
    left = std::min(left, across);
    right = std::max(right, across);
  }
  EXPECT_NEAR(left, -1.0, 1e-6);
  EXPECT_NEAR(right, 0.5, 1e-6);
}

INSTANTIATE_TEST_SUITE_P(Projections, FitAnyView, ::testing::Bool(),
                         [](const auto& p) { return p.param ? "Orthographic" : "Perspective"; });

TEST(Camera, ViewIsARotationThatLooksAtTheTarget) {
  for (const UpAxis up : {UpAxis::y, UpAxis::z}) {
    for (const View view : kViews) {
      const Camera camera = fit(Bounds{{-1, -2, -3}, {4, 5, 6}}, view_axes(view, up), 1.5);
      const Eigen::Matrix4d matrix = camera.view();
      const Eigen::Matrix3d axes = matrix.topLeftCorner<3, 3>();
      EXPECT_TRUE((axes * axes.transpose()).isIdentity(1e-12));
      EXPECT_NEAR(axes.determinant(), 1.0, 1e-12);
      const Vector3d target = (matrix * camera.target.homogeneous()).head<3>();
      EXPECT_NEAR(target.head<2>().norm(), 0.0, 1e-9);
      EXPECT_LT(target.z(), 0.0);
    }
  }
}

TEST(Camera, FrontViewHasUpAtTheTopOfThePicture) {
  for (const auto& [up_axis, up] :
       {std::pair{UpAxis::y, Vector3d(0, 1, 0)}, std::pair{UpAxis::z, Vector3d(0, 0, 1)}}) {
    const Camera camera =
        fit(Bounds{{-1, -1, -1}, {1, 1, 1}}, view_axes(View::front, up_axis), 1.0);
    EXPECT_LT(to_clip(camera, 1.0, up).y(), 0.0);
    EXPECT_GT(to_clip(camera, 1.0, {1, 0, 0}).x(), 0.0);
  }
}

TEST(Camera, NearerPointsHaveGreaterDepth) {
  for (const bool orthographic : {false, true}) {
    const Camera camera = fit(Bounds{{-1, -1, -1}, {1, 1, 1}}, view_axes(View::front), 1.0,
                              {.orthographic = orthographic});
    EXPECT_GT(to_clip(camera, 1.0, {0, 0, 0.5}).z(), to_clip(camera, 1.0, {0, 0, -0.5}).z());
  }
}

TEST(Camera, BothProjectionsAgreeAtTheTarget) {
  Camera camera = fit(Bounds{{-1, -1, -1}, {1, 1, 1}}, view_axes(View::front), 1.0);
  const Vector3d beside = camera.target + Vector3d(0.3, 0.2, 0.0);
  const Vector3d perspective = to_clip(camera, 1.0, beside);
  camera.orthographic = true;
  EXPECT_TRUE(perspective.head<2>().isApprox(to_clip(camera, 1.0, beside).head<2>(), 1e-12));
}

TEST(Camera, FitIgnoresPointsThatAreNotFinite) {
  Positions points = icosphere(1).positions;
  const Camera expected = fit(points, view_axes(View::top), 1.0);
  points.emplace_back(std::nan(""), 0.0, 0.0);
  const Camera camera = fit(points, view_axes(View::top), 1.0);
  EXPECT_EQ(camera.eye, expected.eye);
}

TEST(Camera, FitOfOnePointShowsTheUnitCubeAroundIt) {
  const Positions points{{3, 4, 5}};
  const Camera camera = fit(points, view_axes(View::three_quarter), 1.0);
  EXPECT_TRUE(camera.target.isApprox(points[0], 0.1));
  EXPECT_LT(to_clip(camera, 1.0, {3.4, 4.4, 5.4}).head<2>().cwiseAbs().maxCoeff(), 1.0);
  EXPECT_GT((camera.eye - points[0]).norm(), 1.0);
}

TEST(Camera, FitOfALineSeenEndOnIsFinite) {
  const Positions points{{0, 0, -1}, {0, 0, 1}};
  for (const bool orthographic : {false, true}) {
    const Camera camera = fit(points, view_axes(View::front), 1.0, {.orthographic = orthographic});
    EXPECT_GT((camera.eye - camera.target).norm(), 0.0);
    EXPECT_TRUE(to_clip(camera, 1.0, {0, 0, -1}).allFinite());
  }
}

TEST(Camera, FitDepthHoldsTheBoundsOfAMovedCamera) {
  const Bounds bounds{{-1, -1, -1}, {1, 1, 1}};
  Camera camera = fit(bounds, view_axes(View::front), 1.0);
  camera.eye *= 100.0;
  fit_depth(camera, bounds);
  EXPECT_LE(camera.near_distance, camera.eye.norm() - 1.0);
  EXPECT_GE(camera.far_distance, camera.eye.norm() + 1.0);
  camera.eye = {0, 0, 0.5};
  fit_depth(camera, bounds);
  EXPECT_GT(camera.near_distance, 0.0);
  EXPECT_GT(camera.far_distance, camera.near_distance);
}

TEST(Camera, LineOfSightGoesThroughWhatThePixelShows) {
  const Eigen::Vector2d size(640.0, 400.0);
  for (const bool orthographic : {false, true}) {
    Camera camera =
        fit(Bounds{Vector3d(-1, -2, -3), Vector3d(3, 2, 1)}, view_axes(View::three_quarter),
            size.x() / size.y(), {.orthographic = orthographic, .legend = 0.2});
    for (const Eigen::Vector2d& pixel : {Eigen::Vector2d(0, 0), Eigen::Vector2d(500.5, 33.0)}) {
      const Ray ray = line_of_sight(camera, pixel, size);
      EXPECT_NEAR(ray.direction.norm(), 1.0, 1e-12);
      for (const double distance : {0.0, 2.5}) {
        const Vector3d clip =
            to_clip(camera, size.x() / size.y(), ray.origin + distance * ray.direction);
        EXPECT_NEAR(0.5 * (clip.x() + 1.0) * size.x(), pixel.x(), 1e-9 * size.x());
        EXPECT_NEAR(0.5 * (clip.y() + 1.0) * size.y(), pixel.y(), 1e-9 * size.y());
        if (distance == 0.0) {
          EXPECT_NEAR(clip.z(), 1.0, 1e-9);
        }
      }
    }
  }
}

TEST(Camera, UnknownViewIsRefusedWithTheNamesThereAre) {
  EXPECT_EQ(view_named("three-quarter"), View::three_quarter);
  EXPECT_THAT(error_message<InputError>([] { view_named("frnt"); }),
              ::testing::AllOf(::testing::HasSubstr("frnt"), ::testing::HasSubstr("front, back")));
}

}  // namespace
}  // namespace lapwing
