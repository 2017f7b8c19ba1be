#include "lapwing/render/corner_colors.h"

#include <limits>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "lapwing/mesh/seams.h"
#include "lapwing/mesh/topology.h"
#include "render/textured_square.h"

namespace lapwing {
namespace {

using test::textured_square;
using ::testing::Each;
using ::testing::ElementsAre;
using ::testing::IsEmpty;
using ::testing::SizeIs;

constexpr std::uint32_t kColor = static_cast<std::uint32_t>(CornerSource::color);
constexpr std::uint32_t kImage = static_cast<std::uint32_t>(CornerSource::image);
constexpr std::uint32_t kRed = kColor | 0x0000FFU;
constexpr std::uint32_t kGreen = kColor | 0x00FF00U;
constexpr std::uint32_t kBlue = kColor | 0xFF0000U;

// Returns a material with an image. Triangles that cannot show the image are red.
FileColors skin() {
  FileColors colors;
  colors.images.push_back({1, 1, {1, 2, 3, 255}});
  colors.materials.push_back({.name = "skin", .color = Eigen::Vector3f(1, 0, 0), .image = 0});
  return colors;
}

CornerColors corners_of(const Mesh& mesh, const FileColors& colors) {
  return corner_colors(mesh, mesh, colors);
}

TEST(CornerColors, PolygonsKeepTheTextureCoordinatesOfTheirCorners) {
  const Mesh mesh = textured_square();
  const CornerColors corners = corners_of(mesh, skin());
  EXPECT_THAT(corners.sources, ElementsAre(kImage, kImage, kImage, kImage, kImage, kImage));
  ASSERT_THAT(corners.places, SizeIs(6));
  for (std::size_t c = 0; c < 6; ++c) {
    const Eigen::Vector3d& p = mesh.positions[mesh.topology().triangles[c / 3][c % 3]];
    EXPECT_FLOAT_EQ(corners.places[c][0], static_cast<float>(p.x()));
    EXPECT_FLOAT_EQ(corners.places[c][1], static_cast<float>(1.0 - p.y())) << "rows go downwards";
  }
}

TEST(CornerColors, SeamsNeedNoVerticesOfTheirOwn) {
  // Two triangles that share two vertices, and no texture coordinate.
  Mesh mesh;
  mesh.positions = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
  mesh.add_face(std::array<Index, 3>{0, 1, 2});
  mesh.add_face(std::array<Index, 3>{0, 2, 3});
  MeshAttributes& a = mesh.edit_attributes();
  a.uvs = {{0, 1}, {0.25, 1}, {0.5, 1}, {0.75, 1}};
  a.corner_uvs = {0, 1, 2, 3, 2, 1};
  a.materials = {"skin"};
  a.face_materials = {0, 0};
  std::vector<float> across;
  for (const auto& place : corners_of(mesh, skin()).places) across.push_back(place[0]);
  EXPECT_THAT(across, ElementsAre(0, 0.25F, 0.5F, 0.75F, 0.5F, 0.25F));
}

TEST(CornerColors, ImagesAreScaledMovedAndBroughtNearZero) {
  Mesh mesh = textured_square();
  for (Eigen::Vector2d& uv : mesh.edit_attributes().uvs) uv += Eigen::Vector2d(1e6, -1e6);
  FileColors colors = skin();
  colors.materials[0].uv_scale = {2, 1};
  colors.materials[0].uv_offset = {0.25, 0};
  for (const auto& [x, y] : corners_of(mesh, colors).places) {
    EXPECT_TRUE(x == 0.25F || x == 2.25F) << x;
    EXPECT_TRUE(y == 0.0F || y == 1.0F) << y;
  }
}

TEST(CornerColors, TheFirstThingThatATriangleHasColorsIt) {
  Mesh mesh = textured_square();
  mesh.edit_attributes().vertex_colors.assign(4, {0, 1, 0, 1});
  mesh.edit_attributes().face_colors.assign(1, {0, 0, 1, 1});
  FileColors colors = skin();
  EXPECT_THAT(corners_of(mesh, colors).sources, Each(kImage));
  colors.materials[0].image = kNoIndex;
  EXPECT_THAT(corners_of(mesh, colors).sources, Each(kGreen));
  EXPECT_THAT(corners_of(mesh, colors).places, IsEmpty());
  mesh.edit_attributes().vertex_colors.clear();
  EXPECT_THAT(corners_of(mesh, colors).sources, Each(kBlue));
  mesh.edit_attributes().face_colors.clear();
  EXPECT_THAT(corners_of(mesh, colors).sources, Each(kRed));
  colors.materials[0].color.reset();
  EXPECT_THAT(corners_of(mesh, colors).sources, IsEmpty());
}

TEST(CornerColors, TrianglesWithoutAPlaceHaveTheColorOfTheirMaterial) {
  Mesh mesh = textured_square();
  mesh.edit_attributes().uvs[3].x() = std::numeric_limits<double>::quiet_NaN();
  mesh.topology();
  const auto has_vertex_3 = [&](std::size_t t) {
    return std::ranges::count(mesh.topology().triangles[t], Index{3}) > 0;
  };
  const CornerColors corners = corners_of(mesh, skin());
  ASSERT_NE(has_vertex_3(0), has_vertex_3(1));
  for (std::size_t c = 0; c < 6; ++c) {
    EXPECT_EQ(corners.sources[c], has_vertex_3(c / 3) ? kRed : kImage);
  }
  mesh.edit_attributes().corner_uvs.clear();
  EXPECT_THAT(corners_of(mesh, skin()).sources, Each(kRed));
}

TEST(CornerColors, NamesThatAMeshHasFromElsewhereAreNoMaterials) {
  Mesh mesh = textured_square();
  mesh.edit_attributes().materials[0] = "of another file";
  EXPECT_THAT(corners_of(mesh, skin()).sources, IsEmpty());
  EXPECT_THAT(corners_of(mesh, {}).sources, IsEmpty());
}

TEST(CornerColors, JoinedSeamsKeepWhatEachSideHas) {
  // The two triangles touch along an edge, but have separate vertices and colours.
  Mesh mesh;
  mesh.positions = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 0, 0}, {1, 1, 0}, {0, 1, 0}};
  mesh.add_face(std::array<Index, 3>{0, 1, 2});
  mesh.add_face(std::array<Index, 3>{3, 4, 5});
  mesh.edit_attributes().vertex_colors.assign(3, {1, 0, 0, 1});
  mesh.edit_attributes().vertex_colors.resize(6, {0, 0, 1, 1});
  const JoinedSurface joined = joined_surface(mesh);
  ASSERT_FALSE(joined.empty());
  EXPECT_THAT(corner_colors(joined.surface, mesh, {}).sources,
              ElementsAre(kRed, kRed, kRed, kBlue, kBlue, kBlue));
  EXPECT_THAT(corner_colors(textured_square(), mesh, {}).sources, IsEmpty()) << "other corners";
}

}  // namespace
}  // namespace lapwing
