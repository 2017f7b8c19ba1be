#include "lapwing/mesh/shapes.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include "lapwing/base/errors.h"
#include "lapwing/mesh/edges.h"

namespace lapwing {
namespace {

// Returns the volume of a closed mesh. The volume is negative if the mesh is inside out.
double volume(const Mesh& mesh) {
  double six_times = 0.0;
  for (std::size_t f = 0; f < mesh.face_count(); ++f) {
    const auto t = mesh.face(f);
    six_times += mesh.positions[t[0]].dot(mesh.positions[t[1]].cross(mesh.positions[t[2]]));
  }
  return six_times / 6.0;
}

bool is_closed(const Mesh& mesh) {
  const Edges edges = build_edges(mesh);
  for (std::size_t e = 0; e < edges.count(); ++e) {
    if (edges.sides.size(e) != 2) return false;
  }
  return true;
}

TEST(Shapes, BarIsAClosedBoxThatFacesOutward) {
  const Mesh mesh = bar(3, 5, 2.0, 7.0);
  EXPECT_TRUE(is_closed(mesh));
  EXPECT_EQ(mesh.vertex_count(), 2U * 4 * 4 + 4U * 3 * 4);
  EXPECT_NEAR(volume(mesh), 2.0 * 2.0 * 7.0, 1e-12);
  EXPECT_EQ(bounds_of(mesh.positions).min, Eigen::Vector3d(-1, -1, 0));
  EXPECT_EQ(bounds_of(mesh.positions).max, Eigen::Vector3d(1, 1, 7));
}

TEST(Shapes, BumpyPlaneHasItsBumpsAndAFlatBorder) {
  const Mesh mesh = bumpy_plane(40, 2, 0.1);
  std::size_t summits = 0;
  for (const Eigen::Vector3d& p : mesh.positions) {
    EXPECT_GE(p.z(), 0.0);
    EXPECT_LE(p.z(), 0.1);
    if (p.z() > 0.1 - 1e-12) ++summits;
    const bool border = p.head<2>().minCoeff() == 0.0 || p.head<2>().maxCoeff() == 1.0;
    if (border) {
      EXPECT_LT(p.z(), 1e-12);
    }
  }
  EXPECT_EQ(summits, 4U);
}

TEST(Shapes, RipplesAreACylindersOwn) {
  const Mesh smooth = cylinder(60, 121, 0.5, 6.0);
  const Mesh rippled = rippled_cylinder();
  double largest = 0.0;
  for (std::size_t v = 0; v < smooth.vertex_count(); ++v) {
    EXPECT_EQ(rippled.positions[v].z(), smooth.positions[v].z());
    largest = std::max(largest, (rippled.positions[v] - smooth.positions[v]).norm());
  }
  EXPECT_NEAR(largest, 0.03 * 0.5, 1e-3);
}

TEST(Shapes, OfMoreTrianglesThanAllowedAreRefused) {
  EXPECT_THROW(grid(100'000, 100'000), InputError);
  EXPECT_THROW(icosphere(20), InputError);
  EXPECT_THROW(cylinder(100'000, 1000, 1.0, 1.0), InputError);
  EXPECT_THROW(bar(3000, 3000, 1.0, 1.0), InputError);
  EXPECT_THROW(torus(10'000, 10'000, 1.0, 0.4), InputError);
}

}  // namespace
}  // namespace lapwing
