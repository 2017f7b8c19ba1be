#include "lapwing/parameterize/uv_mesh.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "lapwing/mesh/compact.h"
#include "parameterize/test_patches.h"

namespace lapwing {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;
using test::placed;
using test::PlacedPatch;
using ::testing::Each;

Mesh with_map(const Mesh& mesh, const PlacedPatch& patch, const DomainMap& map) {
  Mesh result = with_uvs(mesh, patch.patch, map.points);
  EXPECT_NO_THROW(validate_attributes(result));
  EXPECT_NO_THROW(validate_indices(result));
  return result;
}

TEST(UvMesh, CornersOfThePatchHaveTheirPlaceAndOthersNone) {
  const Mesh mesh = icosphere(3);
  const PlacedPatch patch = placed(mesh, {GeodesicDisk{Index{17}, 0.7}, "region"});
  const DomainMap map = patch.map(Domain::disk);
  const Mesh result = with_map(mesh, patch, map);
  EXPECT_EQ(result.positions, mesh.positions);
  EXPECT_EQ(result.face_vertices(), mesh.face_vertices());
  std::vector<char> in_patch(mesh.face_count(), 0);
  for (const Index t : patch.patch.triangle_sources) in_patch[t] = 1;
  for (std::size_t c = 0; c < mesh.face_vertices().size(); ++c) {
    const Index uv = result.attributes().corner_uvs[c];
    if (in_patch[c / 3] != 0) {
      EXPECT_EQ(uv, patch.patch.own_number(mesh.face_vertices()[c]));
    } else {
      EXPECT_EQ(uv, kNoIndex);
    }
  }
  EXPECT_EQ(result.attributes().uvs, map.points);
}

TEST(UvMesh, HalvedEdgesBecomeVerticesThatKeepTheShape) {
  // Two quads side by side: the edge between them, and both diagonals, join boundary vertices.
  Mesh mesh;
  mesh.positions = {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {0, 1, 0}, {1, 1, 0}, {2, 1, 1}};
  mesh.add_face(std::array<Index, 4>{0, 1, 4, 3});
  mesh.add_face(std::array<Index, 4>{1, 2, 5, 4});
  mesh.edit_attributes().face_colors = {{1, 0, 0, 1}, {0, 1, 0, 1}};
  mesh.edit_attributes().vertex_colors.assign(6, {0.5F, 0.5F, 0.5F, 1});
  const PlacedPatch patch = placed(mesh);
  const Mesh result = with_map(mesh, patch, patch.map(Domain::disk));
  EXPECT_EQ(result.vertex_count(), 6U + 3U);
  EXPECT_EQ(result.face_count(), patch.patch.triangles.size());
  for (std::size_t f = 0; f < result.face_count(); ++f) {
    for (std::size_t k = 0; k < 3; ++k) {
      const Index uv = result.attributes().corner_uvs[3 * f + k];
      EXPECT_EQ(uv, patch.patch.triangles[f][k]);
      EXPECT_EQ(result.positions[result.face(f)[k]], patch.positions[uv]);
    }
    const bool is_first = result.attributes().face_colors[f] == mesh.attributes().face_colors[0];
    for (const Index v : result.face(f)) EXPECT_LE(result.positions[v].x(), is_first ? 1.0 : 2.0);
  }
}

TEST(UvMesh, PolygonOnTheEdgeOfThePatchHasNoCoordinates) {
  Mesh mesh;  // a quad of which the region holds one half, beside a triangle
  mesh.positions = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {2, 0, 0}};
  mesh.add_face(std::array<Index, 4>{0, 1, 2, 3});
  mesh.add_face(std::array<Index, 3>{1, 4, 2});
  const PlacedPatch patch = placed(mesh, {ListedVertices{{0, 1, 2}}, "region"});
  const Mesh result = with_map(mesh, patch, patch.map(Domain::disk));
  EXPECT_EQ(result.face_starts(), mesh.face_starts());
  EXPECT_THAT(result.attributes().corner_uvs, Each(kNoIndex));
}

TEST(UvMesh, HalfOfAPolygonThatIsNotInThePatchStays) {
  Mesh mesh;  // the patch: half a quad and a triangle, joined over an edge that is halved
  mesh.positions = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {2, 0, 0}};
  mesh.add_face(std::array<Index, 4>{0, 1, 2, 3});
  mesh.add_face(std::array<Index, 3>{1, 4, 2});
  const PlacedPatch patch = placed(mesh, {ListedVertices{{0, 1, 2, 4}}, "region"});
  const Mesh result = with_map(mesh, patch, patch.map(Domain::disk));
  EXPECT_EQ(result.vertex_count(), 6U);
  EXPECT_EQ(result.face_count(), 5U) << "four parts, and the other half of the quad";
  double area = 0.0;
  for (const Triangle& t : result.topology().triangles) {
    area += 0.5 * (result.positions[t[1]] - result.positions[t[0]])
                      .cross(result.positions[t[2]] - result.positions[t[0]])
                      .z();
  }
  EXPECT_DOUBLE_EQ(area, 1.5);
}

}  // namespace
}  // namespace lapwing
