#include "lapwing/render/turntable.h"

#include <cmath>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include "lapwing/mesh/shapes.h"

namespace lapwing {
namespace {

using Eigen::Vector3d;

constexpr int kStepsAround = 64;

Vector3d in_clip_space(const Camera& camera, double aspect, const Vector3d& point) {
  const Eigen::Vector4d clip = camera.projection(aspect) * camera.view() * point.homogeneous();
  return clip.hnormalized();
}

// Returns points far from the origin. Their outline differs from every viewing direction.
Positions leaning_torus() {
  Positions points = torus(24, 12, 2.0, 0.5).positions;
  for (Vector3d& p : points) p = Vector3d(p.x() + 1e3 + p.y(), 3.0 * p.y(), 0.4 * p.z() - 50.0);
  return points;
}

class ATurntable : public ::testing::TestWithParam<bool> {};
INSTANTIATE_TEST_SUITE_P(Projections, ATurntable, ::testing::Bool(),
                         [](const auto& i) { return i.param ? "Parallel" : "Perspective"; });

TEST_P(ATurntable, ShowsAllPointsFromAllAroundAsLargeAsTheMarginAllows) {
  const Positions points = leaning_torus();
  const Framing framing{.orthographic = GetParam(), .margin = 0.1};
  for (const UpAxis up : {UpAxis::y, UpAxis::z}) {
    for (const View view : {View::three_quarter, View::left, View::top}) {
      for (const double aspect : {0.5, 1.0, 2.5}) {
        const Turntable way(points, view_axes(view, up), up, aspect, framing);
        double largest = 0.0;
        for (int step = 0; step < kStepsAround; ++step) {
          for (const Vector3d& p : points) {
            const Vector3d clip = in_clip_space(way.camera(step, kStepsAround), aspect, p);
            largest = std::max(largest, clip.head<2>().cwiseAbs().maxCoeff());
            EXPECT_GE(clip.z(), 0.0);
            EXPECT_LE(clip.z(), 1.0);
          }
        }
        const double whole = 1.0 - 2.0 * framing.margin;
        EXPECT_LE(largest, whole + 1e-9);
        EXPECT_GT(largest, 0.98 * whole);
      }
    }
  }
}

TEST_P(ATurntable, TurnsWhatItShowsInItsPlace) {
  const Positions points = leaning_torus();
  const Vector3d middle = bounds_of(points).center();
  const Turntable way(points, view_axes(View::three_quarter), UpAxis::y, 1.5,
                      {.orthographic = GetParam()});
  const Camera first = way.camera(0, kStepsAround);
  const Vector3d place = in_clip_space(first, 1.5, middle);
  EXPECT_NEAR(place.x(), 0.0, 1e-9);
  for (int step = 1; step <= kStepsAround; ++step) {
    const Camera camera = way.camera(step, kStepsAround);
    EXPECT_LT((in_clip_space(camera, 1.5, middle) - place).norm(), 1e-9)
        << "no larger and no higher";
    EXPECT_NEAR((camera.eye - middle).norm(), (first.eye - middle).norm(), 1e-9);
    EXPECT_NEAR(camera.eye.y(), first.eye.y(), 1e-9);
  }
}

TEST_P(ATurntable, GoesOnceAroundToTheRight) {
  const Turntable way(leaning_torus(), view_axes(View::front), UpAxis::y, 1.0,
                      {.orthographic = GetParam()});
  const auto toward_eye = [&](int step) {
    const Camera camera = way.camera(step, 4);
    return (camera.eye - camera.target).normalized().eval();
  };
  EXPECT_LT((toward_eye(0) - view_axes(View::front).toward_eye).norm(), 1e-12);
  EXPECT_LT((toward_eye(1) - view_axes(View::right).toward_eye).norm(), 1e-12);
  EXPECT_LT((toward_eye(3) - view_axes(View::left).toward_eye).norm(), 1e-12);
  const Camera last = way.camera(4, 4);
  EXPECT_LT((last.eye - way.camera(0, 4).eye).norm(), 1e-9) << "so that it loops";
}

TEST_P(ATurntable, SeenFromAboveTurnsThePicture) {
  const Turntable way(leaning_torus(), view_axes(View::top), UpAxis::y, 1.0,
                      {.orthographic = GetParam()});
  const Camera quarter = way.camera(1, 4);
  EXPECT_LT(((quarter.eye - quarter.target).normalized() - Vector3d::UnitY()).norm(), 1e-9);
  EXPECT_LT((quarter.up - Vector3d(-1, 0, 0)).norm(), 1e-12);
}

TEST_P(ATurntable, LeavesTheLegendItsPartAtTheRight) {
  const Positions points = torus(24, 12, 2.0, 0.5).positions;
  const Framing framing{.orthographic = GetParam(), .margin = 0.0, .legend = 0.25};
  const Turntable way(points, view_axes(View::three_quarter), UpAxis::y, 0.8, framing);
  double right = -1.0;
  for (int step = 0; step < kStepsAround; ++step) {
    for (const Vector3d& p : points) {
      right = std::max(right, in_clip_space(way.camera(step, kStepsAround), 0.8, p).x());
    }
  }
  EXPECT_LE(right, 0.5 + 1e-9);
  EXPECT_GT(right, 0.45);
}

TEST(Turntable, OfASinglePointAndOfALineAlongTheAxisHasADistance) {
  for (const Positions& points :
       {Positions{Vector3d(1, 2, 3)}, Positions{Vector3d(1, 2, 3), Vector3d(1, 5, 3)}}) {
    const Camera camera = Turntable(points, view_axes(View::front), UpAxis::y, 1.0).camera(1, 3);
    EXPECT_TRUE(camera.eye.allFinite());
    EXPECT_GT((camera.eye - camera.target).norm(), 0.1);
  }
}

}  // namespace
}  // namespace lapwing
