#include "lapwing/mesh/decimate_mesh.h"

#include <algorithm>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "lapwing/base/errors.h"
#include "lapwing/mesh/compact.h"
#include "lapwing/mesh/seams.h"
#include "lapwing/mesh/shapes.h"
#include "lapwing/mesh/topology.h"

namespace lapwing {
namespace {

using ::testing::HasSubstr;
using ::testing::IsEmpty;

TEST(DecimateMesh, KeepsAboutTheShareOfTheVertices) {
  const Mesh ball = icosphere(4);
  const DecimatedMesh coarse = decimate(ball, {.share = 0.25});
  EXPECT_NEAR(static_cast<double>(coarse.mesh.vertex_count()) / 2562.0, 0.25, 0.05);
  for (std::size_t v = 0; v < coarse.kept.size(); ++v) {
    EXPECT_EQ(coarse.mesh.positions[v], ball.positions[coarse.kept[v]]);
  }
  EXPECT_THAT(why_no_surface(coarse.mesh), IsEmpty());
}

TEST(DecimateMesh, KeepsVertexAndFaceAttributes) {
  Mesh ball = icosphere(3);
  MeshAttributes& a = ball.edit_attributes();
  for (const Eigen::Vector3d& p : ball.positions) {
    a.vertex_colors.emplace_back(p.x() > 0 ? 1.0F : 0.0F, 0.0F, 0.0F, 1.0F);
  }
  a.materials = {"left", "right"};
  for (std::size_t f = 0; f < ball.face_count(); ++f) {
    double x = 0.0;
    for (const Index v : ball.face(f)) x += ball.positions[v].x();
    a.face_materials.push_back(x > 0.0 ? 1 : 0);
  }
  const Mesh coarse = decimate(ball, {.share = 0.3}).mesh;
  validate_attributes(coarse);
  EXPECT_LT(coarse.vertex_count(), ball.vertex_count());
  for (std::size_t f = 0; f < coarse.face_count(); ++f) {
    double x = 0.0;
    for (const Index v : coarse.face(f)) x += coarse.positions[v].x();
    if (std::abs(x) < 0.5) continue;
    EXPECT_EQ(coarse.attributes().face_materials[f], x > 0.0 ? 1U : 0U);
  }
  for (std::size_t v = 0; v < coarse.vertex_count(); ++v) {
    EXPECT_EQ(coarse.attributes().vertex_colors[v].x(), coarse.positions[v].x() > 0 ? 1.0F : 0.0F);
  }
}

TEST(DecimateMesh, SeamsOfTextureCoordinatesStay) {
  // Two charts that meet at x = 0.5; each maps x and y to u and v, the right one shifted by 2.
  Mesh sheet = grid(20, 20);
  MeshAttributes& a = sheet.edit_attributes();
  for (const double shift : {0.0, 2.0}) {
    for (const Eigen::Vector3d& p : sheet.positions) a.uvs.emplace_back(p.x() + shift, p.y());
  }
  const auto n = static_cast<Index>(sheet.vertex_count());
  for (std::size_t f = 0; f < sheet.face_count(); ++f) {
    double x = 0.0;
    for (const Index v : sheet.face(f)) x += sheet.positions[v].x() / 3.0;
    for (const Index v : sheet.face(f)) a.corner_uvs.push_back(x > 0.5 ? n + v : v);
  }
  const Mesh coarse = decimate(sheet, {.share = 0.3}).mesh;
  EXPECT_LT(coarse.vertex_count(), sheet.vertex_count() / 2);
  for (std::size_t c = 0; c < coarse.face_vertices().size(); ++c) {
    const Eigen::Vector3d& p = coarse.positions[coarse.face_vertices()[c]];
    const Eigen::Vector2d& uv = coarse.attributes().uvs[coarse.attributes().corner_uvs[c]];
    double x = 0.0;
    for (const Index v : coarse.face(c / 3)) x += coarse.positions[v].x() / 3.0;
    EXPECT_DOUBLE_EQ(uv.x(), p.x() + (x > 0.5 ? 2.0 : 0.0));
    EXPECT_EQ(uv.y(), p.y());
  }
}

TEST(DecimateMesh, UnweldedSeamsStayClosed) {
  // Two halves of a tube that share no vertices.
  Mesh tube = cylinder(16, 17, 1.0, 4.0);
  const auto n = static_cast<Index>(tube.vertex_count());
  Mesh split = tube;
  split.positions.insert(split.positions.end(), tube.positions.begin(), tube.positions.end());
  std::vector<Index>& corners = split.edit_faces().vertices;
  for (std::size_t c = 0; c < corners.size(); c += 3) {
    double x = 0.0;
    for (std::size_t k = 0; k < 3; ++k) x += tube.positions[corners[c + k]].x();
    for (std::size_t k = 0; k < 3 && x > 0.0; ++k) corners[c + k] += n;
  }
  const Mesh coarse = decimate(split, {.share = 0.3}).mesh;
  EXPECT_EQ(joined_surface(coarse).edges.size(), joined_surface(split).edges.size());
}

TEST(DecimateMesh, PolygonsAreTriangulated) {
  Mesh quads = grid(8, 8);
  Mesh mesh;
  mesh.positions = quads.positions;
  for (Index r = 0; r < 8; ++r) {
    for (Index c = 0; c < 8; ++c) {
      const Index v = 9 * r + c;
      mesh.add_face(std::array<Index, 4>{v, v + 1, v + 10, v + 9});
    }
  }
  const Mesh coarse = decimate(mesh, {.share = 0.5}).mesh;
  for (std::size_t f = 0; f < coarse.face_count(); ++f) EXPECT_EQ(coarse.face(f).size(), 3U);
}

TEST(DecimateMesh, RefusesSharesOutsideItsRange) {
  for (const double share : {0.0, -1.0, 1.5}) {
    try {
      decimate(icosphere(1), {.share = share, .where = "--share"});
      FAIL() << share;
    } catch (const InputError& error) {
      EXPECT_THAT(error.what(), HasSubstr("--share: the share of vertices must be above 0"));
    }
  }
  EXPECT_THROW(decimate(Mesh{}, {}), InputError);
}

}  // namespace
}  // namespace lapwing
