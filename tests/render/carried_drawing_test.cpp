// Meshes and points that are drawn with a surface.
#include <gtest/gtest.h>

#include "lapwing/mesh/shapes.h"
#include "lapwing/mesh/transform.h"
#include "lapwing/render/point_cloud.h"
#include "render/picture.h"
#include "support/gpu.h"

namespace lapwing {
namespace {

using test::Subject;

// Counts the pixels in the colour of attachments. Neither the clay nor the background is greenish.
std::size_t greenish(const Image& image) {
  std::size_t count = 0;
  for (std::uint32_t y = 0; y < image.height; ++y) {
    for (std::uint32_t x = 0; x < image.width; ++x) {
      const auto pixel = image.pixel(x, y);
      count += pixel[1] > pixel[0] + 20 && pixel[1] >= pixel[2] ? 1 : 0;
    }
  }
  return count;
}

class CarriedDrawings : public ::testing::Test {
 protected:
  void SetUp() override {
    LAPWING_NEEDS_GPU();
    sphere_.emplace(icosphere(3));
    // Leave room for objects around the sphere.
    fit_depth(sphere_->camera, {{-2.0, -2.0, -2.0}, {2.0, 2.0, 2.0}});
  }
  std::size_t shown(const CarriedDrawing& drawing) {
    return greenish(render_image(sphere_->surface, sphere_->paint, sphere_->camera,
                                 sphere_->options, {&drawing, 1}));
  }
  std::optional<Subject> sphere_;
};

TEST_F(CarriedDrawings, AMeshShowsBeforeTheSurfaceAndNotBehindIt) {
  EXPECT_EQ(greenish(sphere_->render()), 0U);
  Mesh ball = icosphere(3);
  transform(ball, Eigen::Translation3d(0.0, 0.0, 1.0) * Eigen::Scaling(0.3));
  Surface surface(sphere_->context, ball.positions, ball.topology());
  const SurfacePaint paint(surface);
  EXPECT_GT(shown({&surface, &paint, nullptr}), 500U);
  for (Eigen::Vector3d& p : ball.positions) p.z() -= 2.0;
  surface.place(ball.positions);
  EXPECT_EQ(shown({&surface, &paint, nullptr}), 0U);
}

TEST_F(CarriedDrawings, PointsAreDisksOfAFewPixels) {
  PointCloud points(sphere_->context, Positions{{0.0, 0.0, 1.2}, {0.5, 0.0, 1.2}});
  ASSERT_EQ(points.size(), 2U);
  const std::size_t two = shown({nullptr, nullptr, &points});
  EXPECT_GT(two, 30U);
  EXPECT_LT(two, 110U);
  points.place(Positions{{0.0, 0.0, 1.2}, {0.5, 0.0, -1.2}});
  EXPECT_NEAR(static_cast<double>(shown({nullptr, nullptr, &points})),
              0.5 * static_cast<double>(two), 6.0);
}

TEST_F(CarriedDrawings, PointsOnTheSurfaceStandBeforeIt) {
  const PointCloud before(sphere_->context, Positions{{0.0, 0.0, 1.2}});
  const PointCloud top(sphere_->context, Positions{{0.0, 0.0, 0.999}});
  ASSERT_GT(shown({nullptr, nullptr, &before}), 15U);
  EXPECT_GE(shown({nullptr, nullptr, &top}) + 4, shown({nullptr, nullptr, &before}));
}

}  // namespace
}  // namespace lapwing
