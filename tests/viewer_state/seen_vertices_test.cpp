#include "tools/seen_vertices.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "lapwing/mesh/shapes.h"
#include "viewer_state/test_view.h"

namespace lapwing::viewer::test {
namespace {

// The picture that the device would draw.
std::vector<std::uint32_t> draw(const Mesh& mesh, const Projection& view, Index width,
                                Index height) {
  std::vector<std::uint32_t> ids;
  for (Index y = 0; y < height; ++y) {
    for (Index x = 0; x < width; ++x) {
      const auto point =
          pick_surface(mesh.topology(), mesh.positions, view.ray_through({x + 0.5, y + 0.5}));
      ids.push_back(point ? point->triangle + 1 : 0);
    }
  }
  return ids;
}

// A window of 80 x 60 pixels.
Projection small_view(const Vector3d& eye) {
  return parallel(eye, {0, 0, 0}, 3.0, Vector3d::UnitY(), {80, 60});
}

TEST(SeenVertices, OfASphereAreThoseThatFaceTheEye) {
  const Vector3d eye(1, 2, 6);
  const Projection view = small_view(eye);
  for (const int subdivisions : {2, 4}) {
    const Mesh mesh = icosphere(subdivisions);
    const Topology& topology = mesh.topology();
    const auto ids = draw(mesh, view, 80, 60);
    const SeenVertices seen({ids, 80, 60}, topology, mesh.positions, view);
    for (Index v = 0; v < mesh.vertex_count(); ++v) {
      const double facing = mesh.positions[v].dot(eye.normalized());
      if (facing > 0.15) {
        EXPECT_TRUE(seen(v)) << v;
      } else if (facing < -0.3) {
        EXPECT_FALSE(seen(v)) << v;
      }
    }
  }
}

TEST(SeenVertices, AreInTheWindow) {
  const Mesh mesh = grid(4, 4);
  const Topology& topology = mesh.topology();
  const Projection view = parallel({0.5, 0.5, 5}, {0.5, 0.5, 0}, 0.2, Vector3d::UnitY(), {80, 60});
  const auto ids = draw(mesh, view, 80, 60);
  const SeenVertices seen({ids, 80, 60}, topology, mesh.positions, view);
  EXPECT_TRUE(seen(12)) << "the middle";
  EXPECT_FALSE(seen(0));
}

}  // namespace
}  // namespace lapwing::viewer::test
