#include "tools/projection.h"

#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "lapwing/mesh/shapes.h"
#include "viewer_state/test_view.h"

namespace lapwing::viewer::test {
namespace {

std::vector<Projection> views() {
  return {perspective({1, 2, 5}, {0.2, 0, 0}), parallel({1, 2, 5}, {0, 0, 0}, 3)};
}

TEST(Projection, RayThroughAPixelMeetsThePoint) {
  for (const Projection& view : views()) {
    const Vector3d point(0.3, -0.2, 0.4);
    const Ray ray = view.ray_through(*view.to_pixel(point));
    const Vector3d toward = point - ray.origin;
    EXPECT_GT(toward.dot(ray.direction), 0.0);
    EXPECT_LT(toward.cross(ray.direction).norm(), 1e-9);
  }
}

TEST(Projection, TargetShowsInTheMiddleAndUpIsUp) {
  const Projection view = perspective({0, 0, 5}, {0, 0, 0});
  EXPECT_LT((*view.to_pixel({0, 0, 0}) - 0.5 * kWindow).norm(), 1e-9);
  EXPECT_LT(view.to_pixel({0, 1, 0})->y(), 300.0);
  EXPECT_GT(view.to_pixel({1, 0, 0})->x(), 400.0);
  EXPECT_FALSE(view.to_pixel({0, 0, 6}).has_value()) << "behind the eye";
}

TEST(Projection, LengthOfAPixelShowsAsOne) {
  for (const Projection& view : views()) {
    const Vector3d point(0.3, -0.2, 0.4);
    const Vector3d eyeward = view.toward_eye(point);
    const Vector3d across = eyeward.unitOrthogonal() * view.length_of_pixel(point);
    EXPECT_NEAR((*view.to_pixel(point + across) - *view.to_pixel(point)).norm(), 1.0, 0.02);
  }
}

TEST(PickSurface, FindsTheFirstTriangleAndItsNearestCorner) {
  const Mesh mesh = icosphere(3);
  const Topology& topology = mesh.topology();
  const Projection view = perspective({0, 0, 5}, {0, 0, 0});
  EXPECT_FALSE(pick_surface(topology, mesh.positions, view.ray_through({5, 5})).has_value());
  for (const Index v : {Index{3}, Index{100}, Index{500}}) {
    if (mesh.positions[v].z() < 0.3) continue;
    const auto pick =
        pick_surface(topology, mesh.positions, view.ray_through(*view.to_pixel(mesh.positions[v])));
    ASSERT_TRUE(pick.has_value());
    EXPECT_EQ(pick->vertex, v);
    EXPECT_LT((pick->position - mesh.positions[v]).norm(), 1e-9);
  }
}

}  // namespace
}  // namespace lapwing::viewer::test
