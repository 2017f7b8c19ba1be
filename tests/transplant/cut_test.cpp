#include "lapwing/transplant/cut.h"

#include <algorithm>

#include <Eigen/Geometry>
#include <gmock/gmock.h>

#include "io/rich_mesh.h"
#include "io/temporary_folder.h"
#include "lapwing/base/errors.h"
#include "lapwing/mesh/shapes.h"
#include "lapwing/mesh/topology.h"
#include "support/error_message.h"

namespace lapwing {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

double area_of(const Mesh& mesh) {
  double area = 0.0;
  for (const auto& [a, b, c] : mesh.topology().triangles) {
    const auto& p = mesh.positions;
    area += 0.5 * (p[b] - p[a]).cross(p[c] - p[a]).norm();
  }
  return area;
}

// The polygons of `piece` in numbers of the mesh that it was cut from.
std::vector<std::vector<Index>> polygons_of(const CutPiece& piece) {
  std::vector<std::vector<Index>> polygons;
  for (std::size_t f = 0; f < piece.mesh.face_count(); ++f) {
    polygons.emplace_back();
    for (const Index v : piece.mesh.face(f)) polygons.back().push_back(piece.vertices[v]);
  }
  return polygons;
}

std::vector<std::vector<Index>> polygons_of(const Mesh& mesh) {
  std::vector<std::vector<Index>> polygons;
  for (std::size_t f = 0; f < mesh.face_count(); ++f) {
    polygons.emplace_back(mesh.face(f).begin(), mesh.face(f).end());
  }
  return polygons;
}

// The half of the vertices with z above 0.
VertexSet upper_half(const Mesh& mesh) {
  VertexSet region;
  for (Index v = 0; v < mesh.vertex_count(); ++v) {
    if (mesh.positions[v].z() > 0.0) region.push_back(v);
  }
  return region;
}

struct CutSphere : testing::Test {
  Mesh mesh = icosphere(3);
  VertexSet region = upper_half(mesh);
  CutPiece part = cut_out(mesh, region, "region");
  CutPiece rest = cut_away(mesh, region, "region");
};

TEST_F(CutSphere, PartAndRestHaveEveryPolygonOnce) {
  auto polygons = polygons_of(part);
  const auto others = polygons_of(rest);
  polygons.insert(polygons.end(), others.begin(), others.end());
  std::ranges::sort(polygons);
  auto all = polygons_of(mesh);
  std::ranges::sort(all);
  EXPECT_EQ(polygons, all);
  EXPECT_NEAR(area_of(part.mesh) + area_of(rest.mesh), area_of(mesh), 1e-12);
}

TEST_F(CutSphere, PartHasTheRegionAndTheRestWhatIsLeftWithTheBorder) {
  EXPECT_EQ(part.vertices, region);
  EXPECT_GT(part.mesh.vertex_count() + rest.mesh.vertex_count(), mesh.vertex_count());
  for (std::size_t v = 0; v < rest.vertices.size(); ++v) {
    EXPECT_EQ(rest.mesh.positions[v], mesh.positions[rest.vertices[v]]);
  }
}

TEST(Cut, TakesPolygonsWholeAndDropsWhatOnlyTheyUsed) {
  Mesh mesh;
  for (int v = 0; v < 8; ++v) mesh.positions.emplace_back(v, v % 3, 0);
  mesh.add_face(std::array<Index, 4>{0, 1, 2, 3});
  mesh.add_face(std::array<Index, 3>{2, 1, 4});
  // Vertices 5 to 7 are loose.
  const CutPiece part = cut_out(mesh, {0, 1, 2, 3, 6}, "region");
  EXPECT_THAT(part.vertices, ElementsAre(0, 1, 2, 3));
  EXPECT_THAT(part.mesh.face(0), ElementsAre(0, 1, 2, 3));
  const CutPiece rest = cut_away(mesh, {0, 1, 2, 3, 6}, "region");
  EXPECT_THAT(rest.vertices, ElementsAre(1, 2, 4, 5, 7));
  EXPECT_THAT(rest.mesh.face(0), ElementsAre(1, 0, 2));
}

TEST(Cut, CarriesWhatThePieceUsesOfEveryAttribute) {
  const Mesh mesh = rich_mesh();
  const VertexSet region{0, 1, 5, 6};  // faces 0 and 1, in the first group
  const CutPiece part = cut_out(mesh, region, "region");
  const MeshAttributes& a = part.mesh.attributes();
  ASSERT_EQ(part.mesh.face_count(), 2U);
  EXPECT_THAT(a.groups, ElementsAre("left arm"));
  EXPECT_THAT(a.materials, ElementsAre("wool", "wax"));
  EXPECT_THAT(a.face_materials, ElementsAre(0, 1));
  EXPECT_THAT(a.vertex_extras.at(0).values, ElementsAre(0, 100000, 500000, 600000));
  EXPECT_THAT(a.face_extras.at(0).values, ElementsAre(0.0, 0.1));
  EXPECT_EQ(a.normals.size(), 4U);
  EXPECT_EQ(a.uvs.size(), 4U);
  for (std::size_t c = 0; c < part.mesh.face_vertices().size(); ++c) {
    EXPECT_EQ(a.uvs.at(a.corner_uvs.at(c)),
              part.mesh.positions[part.mesh.face_vertices()[c]].head<2>());
  }
  EXPECT_EQ(a.comments, mesh.attributes().comments);
  EXPECT_THAT(cut_away(mesh, region, "region").mesh.attributes().groups,
              ElementsAre("left arm", "body"));
}

TEST(Cut, PieceIsTheSameAfterAFile) {
  const TemporaryFolder folder;
  for (const std::string name : {"a.obj", "a.ply"}) {
    write_mesh(rich_mesh(), folder / name);
    const Mesh mesh = read_mesh(folder / name);
    const CutPiece rest = cut_away(mesh, {0, 1, 5, 6}, "region");
    EXPECT_EQ(rest.mesh.source, nullptr);
    write_mesh(rest.mesh, folder / ("rest-" + name));
    const Mesh again = read_mesh(folder / ("rest-" + name));
    EXPECT_EQ(again.positions, rest.mesh.positions);
    EXPECT_EQ(polygons_of(again), polygons_of(rest.mesh));
    EXPECT_EQ(at_corners(again.attributes().uvs, again.attributes().corner_uvs),
              at_corners(rest.mesh.attributes().uvs, rest.mesh.attributes().corner_uvs));
  }
}

TEST(Cut, RegionWithoutAPolygonIsNamed) {
  const Mesh mesh = grid(2, 2);
  const VertexSet corners{0, 2, 6, 8};
  EXPECT_THAT(error_message<InputError>([&] { cut_out(mesh, corners, "--region"); }),
              AllOf(HasSubstr("--region"), HasSubstr("(4 vertices)"), HasSubstr("larger")));
  EXPECT_THAT(error_message<InputError>([&] { cut_away(mesh, {}, "--region"); }),
              HasSubstr("nothing is cut"));
}

TEST(Cut, RegionWithEveryPolygonLeavesNothing) {
  const Mesh mesh = grid(1, 1);
  const VertexSet all{0, 1, 2, 3};
  EXPECT_EQ(cut_out(mesh, all, "region").mesh.face_count(), mesh.face_count());
  EXPECT_THAT(error_message<InputError>([&] { cut_away(mesh, all, "region"); }),
              HasSubstr("smaller region"));
}

}  // namespace
}  // namespace lapwing
