#include "lapwing/mesh/subdivide_mesh.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "lapwing/base/errors.h"
#include "lapwing/mesh/compact.h"
#include "lapwing/mesh/shapes.h"
#include "lapwing/mesh/subdivide.h"

namespace lapwing {
namespace {

using ::testing::HasSubstr;

TEST(SubdivideMesh, RepeatsOneSubdivision) {
  const Mesh ball = icosphere(1);
  EXPECT_EQ(subdivide(ball, {.times = 2}).positions, subdivide(subdivide(ball)).positions);
  EXPECT_EQ(subdivide(ball, {.times = 2, .smooth = true}).positions,
            loop_subdivide(loop_subdivide(ball)).positions);
}

TEST(SubdivideMesh, InterpolatesColoursAndTextureCoordinates) {
  Mesh sheet = grid(3, 3);
  MeshAttributes& a = sheet.edit_attributes();
  for (const Eigen::Vector3d& p : sheet.positions) {
    a.uvs.emplace_back(p.x(), p.y());
    a.vertex_colors.emplace_back(static_cast<float>(p.x()), 0.0F, 0.0F, 1.0F);
  }
  a.corner_uvs = sheet.face_vertices();
  a.groups = {"a", "b"};
  for (std::size_t f = 0; f < sheet.face_count(); ++f) a.face_groups.push_back(f % 2);
  a.vertex_extras = {{"label", "int", 2, std::vector<double>(32, 3.0)}};
  a.normals.assign(16, Eigen::Vector3d::UnitZ());
  a.has_vertex_normals = true;
  const Mesh fine = subdivide(sheet, {.times = 2});
  validate_attributes(fine);
  const MeshAttributes& b = fine.attributes();
  for (std::size_t c = 0; c < fine.face_vertices().size(); ++c) {
    const Eigen::Vector3d& p = fine.positions[fine.face_vertices()[c]];
    EXPECT_TRUE(b.uvs[b.corner_uvs[c]].isApprox(p.head<2>()) || p.head<2>().isZero());
  }
  for (std::size_t v = 0; v < fine.vertex_count(); ++v) {
    EXPECT_NEAR(b.vertex_colors[v].x(), fine.positions[v].x(), 1e-6);
  }
  EXPECT_EQ(b.uvs.size(), fine.vertex_count());
  EXPECT_EQ(b.face_groups[16], 1U);
  EXPECT_EQ(b.vertex_extras[0].values.back(), 3.0);
  EXPECT_FALSE(b.has_vertex_normals);
}

TEST(SubdivideMesh, PolygonsAreTriangulated) {
  Mesh square;
  square.positions = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
  square.add_face(std::array<Index, 4>{0, 1, 2, 3});
  EXPECT_EQ(subdivide(square, SubdivideRequest{}).face_count(), 8U);
}

TEST(SubdivideMesh, RefusesToDoNothing) {
  try {
    subdivide(icosphere(0), {.times = 0, .where = "--times"});
    FAIL();
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), HasSubstr("--times: the number of subdivisions"));
  }
}

}  // namespace
}  // namespace lapwing
