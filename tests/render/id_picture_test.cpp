#include "lapwing/render/id_picture.h"

#include <limits>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include "lapwing/mesh/shapes.h"
#include "render/picture.h"
#include "support/gpu.h"

namespace lapwing {
namespace {

using Eigen::Vector3d;
using test::Subject;

struct Hit {
  Index triangle = kNoIndex;
  double distance = std::numeric_limits<double>::infinity();
  double border = 0.0;  ///< the smallest barycentric weight
};

// The CPU twin. It intersects every triangle with the viewing ray through the pixel's centre.
Hit cast(const Subject& subject, std::uint32_t x, std::uint32_t y, std::uint32_t size) {
  const Ray ray = line_of_sight(subject.camera, {x + 0.5, y + 0.5},
                                Eigen::Vector2d::Constant(static_cast<double>(size)));
  Hit nearest;
  for (Index t = 0; t < subject.mesh.topology().triangles.size(); ++t) {
    const Triangle& triangle = subject.mesh.topology().triangles[t];
    Eigen::Matrix3d corners;
    for (int c = 0; c < 3; ++c) {
      corners.col(c) = subject.mesh.positions[triangle[static_cast<std::size_t>(c)]] - ray.origin;
    }
    const Vector3d weights =
        corners.inverse() * ray.direction;  // barycentric coordinates divided by the distance
    const double distance = 1.0 / weights.sum();
    const double border = weights.minCoeff() * distance;
    if (!(distance > 0.0) || border < 0.0 || distance >= nearest.distance) continue;
    nearest = {t, distance, border};
  }
  return nearest;
}

constexpr std::uint32_t kSize = 96;

void expect_same_as_ray_cast(Subject& subject) {
  IdPicture picture(subject.surface.context());
  picture.draw(subject.surface, subject.camera, kSize, kSize);
  std::size_t hits = 0;
  for (std::uint32_t y = 0; y < kSize; y += 3) {
    for (std::uint32_t x = 0; x < kSize; x += 3) {
      const auto pick = picture.pick(subject.surface, x, y);
      const Hit hit = cast(subject, x, y, kSize);
      if (hit.triangle != kNoIndex && hit.border < 1e-3) continue;  // depends on rounding
      ASSERT_EQ(pick.has_value(), hit.triangle != kNoIndex) << x << ", " << y;
      if (!pick) continue;
      ++hits;
      ASSERT_EQ(pick->triangle, hit.triangle) << x << ", " << y;
      const Ray ray = line_of_sight(subject.camera, {x + 0.5, y + 0.5}, {kSize, kSize});
      ASSERT_LT((pick->position - ray.origin - hit.distance * ray.direction).norm(), 1e-5);
      for (const Index corner : subject.mesh.topology().triangles[hit.triangle]) {
        EXPECT_LE((subject.mesh.positions[pick->vertex] - pick->position).norm(),
                  (subject.mesh.positions[corner] - pick->position).norm() + 1e-6);
      }
    }
  }
  EXPECT_GT(hits, 100U);
}

TEST(IdPicture, PicksWhatARayHitsInBothProjections) {
  LAPWING_NEEDS_GPU();
  Subject subject(torus(32, 16, 1.0, 0.4));
  for (const bool orthographic : {false, true}) {
    subject.camera = fit(subject.mesh.positions, view_axes(View::three_quarter), 1.0,
                         {.orthographic = orthographic});
    expect_same_as_ray_cast(subject);
  }
}

TEST(IdPicture, PicksFarFromTheOrigin) {
  LAPWING_NEEDS_GPU();
  Mesh far = icosphere(2);
  for (Vector3d& p : far.positions) p += Vector3d(1e5, -2e5, 3e5);
  Subject subject(far);
  subject.camera = fit(far.positions, view_axes(View::three_quarter), 1.0);
  expect_same_as_ray_cast(subject);
}

TEST(IdPicture, DepthIsAlongTheViewingDirection) {
  LAPWING_NEEDS_GPU();
  Subject square(grid(1, 1));
  square.camera = fit(square.mesh.positions, view_axes(View::front), 1.0);
  IdPicture picture(square.surface.context());
  picture.draw(square.surface, square.camera, kSize, kSize);
  for (const std::uint32_t x : {20U, 50U, 80U}) {
    const auto pick = picture.pick(square.surface, x, 30);
    ASSERT_TRUE(pick);
    EXPECT_NEAR(pick->depth, square.camera.eye.z(), 1e-5);
  }
}

TEST(IdPicture, BackgroundAndOutsideAreNothing) {
  LAPWING_NEEDS_GPU();
  Subject sphere(icosphere(2));
  IdPicture picture(sphere.surface.context());
  EXPECT_FALSE(picture.pick(sphere.surface, 0, 0));
  picture.draw(sphere.surface, sphere.camera, kSize, kSize);
  EXPECT_FALSE(picture.pick(sphere.surface, 0, 0));
  EXPECT_FALSE(picture.pick(sphere.surface, kSize, 0));
  EXPECT_TRUE(picture.pick(sphere.surface, kSize / 2, kSize / 2));
}

TEST(IdPicture, FollowsTheSurfaceAndTheSize) {
  LAPWING_NEEDS_GPU();
  Subject sphere(icosphere(3));
  IdPicture picture(sphere.surface.context());
  const auto count = [&](std::uint32_t width, std::uint32_t height) {
    picture.draw(sphere.surface, sphere.camera, width, height);
    std::size_t covered = 0;
    for (const std::uint32_t id : picture.ids()) covered += id != 0 ? 1 : 0;
    return covered;
  };
  const std::size_t whole = count(kSize, kSize);
  EXPECT_NEAR(static_cast<double>(count(2 * kSize, 2 * kSize)), 4.0 * static_cast<double>(whole),
              0.05 * static_cast<double>(whole));
  sphere.move_by(10.0);
  EXPECT_EQ(count(kSize, kSize), 0U);
}

TEST(IdPicture, SurfaceWithoutTrianglesIsNothing) {
  LAPWING_NEEDS_GPU();
  Mesh points;
  points.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  Subject subject(points);
  IdPicture picture(subject.surface.context());
  picture.draw(subject.surface, subject.camera, kSize, kSize);
  EXPECT_FALSE(picture.pick(subject.surface, kSize / 2, kSize / 2));
}

}  // namespace
}  // namespace lapwing
