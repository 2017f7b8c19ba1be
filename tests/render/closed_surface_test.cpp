#include "lapwing/render/closed_surface.h"

#include <utility>

#include <gtest/gtest.h>

#include "lapwing/mesh/shapes.h"
#include "lapwing/mesh/transform.h"
#include "support/joined_meshes.h"

namespace lapwing {
namespace {

bool closed_outward(const Mesh& mesh) {
  return is_closed_outward(mesh.positions, mesh.topology().triangles);
}

Mesh turned_inside_out(Mesh mesh) {
  for (std::size_t f = 0; f < mesh.face_count(); ++f) {
    Faces& faces = mesh.edit_faces();
    std::swap(faces.vertices[faces.starts[f]], faces.vertices[faces.starts[f] + 1]);
  }
  return mesh;
}

// Returns a mesh that contains `a`, and `b` far from the origin.
Mesh both(const Mesh& a, Mesh b) {
  transform(b, Eigen::Affine3d(Eigen::Translation3d(1e6, 0.0, 0.0)));
  return test::joined(a, b);
}

TEST(ClosedSurface, ClosedShapesAre) {
  EXPECT_TRUE(closed_outward(icosphere(2)));
  EXPECT_TRUE(closed_outward(torus(12, 8, 1.0, 0.3)));
  EXPECT_TRUE(closed_outward(both(icosphere(1), icosphere(2))));
}

TEST(ClosedSurface, OpenShapesAreNot) {
  EXPECT_FALSE(closed_outward(grid(4, 4)));
  EXPECT_FALSE(closed_outward(cylinder(8, 5, 1.0, 2.0)));
  EXPECT_FALSE(closed_outward(both(icosphere(2), grid(4, 4))));
  EXPECT_FALSE(closed_outward(Mesh{}));
}

TEST(ClosedSurface, ShapesTurnedInsideOutAreNot) {
  EXPECT_FALSE(closed_outward(turned_inside_out(icosphere(2))));
  EXPECT_FALSE(closed_outward(both(icosphere(3), turned_inside_out(icosphere(1)))));
}

TEST(ClosedSurface, OneFlippedFaceIsSeen) {
  Mesh sphere = icosphere(2);
  std::swap(sphere.edit_faces().vertices[0], sphere.edit_faces().vertices[1]);
  EXPECT_FALSE(closed_outward(sphere));
}

}  // namespace
}  // namespace lapwing
