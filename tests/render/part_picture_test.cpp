#include "lapwing/render/part_picture.h"

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include "lapwing/base/errors.h"
#include "lapwing/mesh/shapes.h"
#include "lapwing/region/boundary_loops.h"
#include "lapwing/transplant/cut.h"
#include "render/picture.h"
#include "support/gpu.h"

namespace lapwing {
namespace {

// Returns a hemisphere that is open at the bottom.
Mesh dome() {
  const Mesh sphere = icosphere(3);
  VertexSet upper;
  for (Index v = 0; v < sphere.vertex_count(); ++v) {
    if (sphere.positions[v].y() > -0.05) upper.push_back(v);
  }
  return cut_out(sphere, upper, "upper").mesh;
}

BoundaryLoop loop_of(const Mesh& mesh) {
  return boundary_loops(mesh.topology().triangles, "mesh").at(0);
}

Image picture_of(const Mesh& mesh) {
  return part_picture(std::make_shared<gpu::Context>(), mesh, loop_of(mesh), 96);
}

TEST(PartPicture, ShowsThePartWithItsLoopBelow) {
  LAPWING_NEEDS_GPU();
  const Image image = picture_of(dome());
  EXPECT_EQ(image.width, 96U);
  EXPECT_GT(test::coverage(image), 0.3);
  double yellow = 0.0;
  double rows = 0.0;
  for (std::uint32_t y = 0; y < image.height; ++y) {
    for (std::uint32_t x = 0; x < image.width; ++x) {
      const auto [red, green, blue, opacity] = image.pixel(x, y);
      if (opacity < 255 || red < blue + 40) continue;
      yellow += 1.0;
      rows += y;
    }
  }
  ASSERT_GT(yellow, 20.0);
  EXPECT_GT(rows / yellow, 56.0);
}

TEST(PartPicture, PartStandsOnItsLoopHoweverItLies) {
  LAPWING_NEEDS_GPU();
  const Image upright = picture_of(dome());
  Mesh hanging = dome();
  for (auto& p : hanging.positions) {
    p = 3.0 * Eigen::Vector3d(p.x(), -p.y(), -p.z()) + Eigen::Vector3d(5, 5, 5);
  }
  // A sphere looks the same from all sides, and its mesh nearly the same.
  EXPECT_LT(test::mean_difference(upright, picture_of(hanging)), 6.0);
}

TEST(PartPicture, FlatPartIsSeenAcross) {
  LAPWING_NEEDS_GPU();
  Mesh wing = dome();
  for (auto& p : wing.positions) p = Eigen::Vector3d(0.1 * p.x(), p.y(), p.z());
  Mesh turned = dome();
  for (auto& p : turned.positions) p = Eigen::Vector3d(p.x(), p.y(), 0.1 * p.z());
  EXPECT_GT(test::coverage(picture_of(turned)), 0.2);
  EXPECT_NEAR(test::coverage(picture_of(wing)), test::coverage(picture_of(turned)), 0.02);
}

TEST(PartPicture, LoopWithoutAPlaneIsRefused) {
  LAPWING_NEEDS_GPU();
  const auto context = std::make_shared<gpu::Context>();
  const Mesh mesh = dome();
  EXPECT_THROW(part_picture(context, mesh, std::vector<Index>{0, 1}, 96), InputError);
}

}  // namespace
}  // namespace lapwing
