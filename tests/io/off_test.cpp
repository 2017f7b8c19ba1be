#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "io/temporary_folder.h"
#include "lapwing/io/mesh_file.h"

namespace lapwing {
namespace {

using ::testing::ElementsAre;

Mesh read_off_text(std::string_view text) {
  const TemporaryFolder folder;
  return read_mesh(folder.file("a.off", text));
}

class OffHeader : public ::testing::TestWithParam<std::string> {};

TEST_P(OffHeader, SpellingDoesNotMatter) {
  const Mesh mesh = read_off_text(GetParam() + "0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n");
  EXPECT_EQ(mesh.vertex_count(), 3U);
  EXPECT_THAT(mesh.face_vertices(), ElementsAre(0, 1, 2));
}

INSTANTIATE_TEST_SUITE_P(All, OffHeader,
                         ::testing::Values("OFF\n3 1 0\n", "OFF 3 1 0\n", "OFF3 1 0\n", "3 1 0\n",
                                           "# note\nOFF # it is\n\n# more\n3 1\n",
                                           "OFF\r\n3 1 0\r\n", "OFF\n3\n1\n0\n"));

TEST(Off, PrefixesSayWhatAVertexHolds) {
  const Mesh mesh = read_off_text("STCNOFF\n1 0 0\n1 2 3  0 0 1  255 0 51 255  0.25 0.75\n");
  EXPECT_EQ(mesh.positions[0], Eigen::Vector3d(1, 2, 3));
  EXPECT_TRUE(mesh.attributes().has_vertex_normals);
  EXPECT_EQ(mesh.attributes().normals[0], Eigen::Vector3d(0, 0, 1));
  EXPECT_EQ(mesh.attributes().vertex_colors[0], Eigen::Vector4f(1, 0, 0.2F, 1));
  EXPECT_EQ(mesh.attributes().uvs[0], Eigen::Vector2d(0.25, 0.75));
}

class OffPrefixes : public ::testing::TestWithParam<std::string> {};

TEST_P(OffPrefixes, MayBeInAnyOrder) {
  const MeshAttributes a =
      read_off_text(GetParam() + "OFF\n1 0 0\n1 2 3  0 0 1  255 0 51 255  0.25 0.75\n")
          .attributes();
  EXPECT_THAT(a.normals, ElementsAre(Eigen::Vector3d(0, 0, 1)));
  EXPECT_THAT(a.vertex_colors, ElementsAre(Eigen::Vector4f(1, 0, 0.2F, 1)));
  EXPECT_THAT(a.uvs, ElementsAre(Eigen::Vector2d(0.25, 0.75)));
}

INSTANTIATE_TEST_SUITE_P(All, OffPrefixes,
                         ::testing::Values("NCST", "CNST", "STNC", "NSTC", "CSTN"));

TEST(Off, MeshLabWritesColoursBeforeNormals) {
  const TemporaryFolder folder;
  Mesh mesh = read_mesh(folder.file("a.off",
                                    "NCSTOFF\n3 1 0\n0 0 0 255 0 51 255 0 0 1 0.25 0.75 \n"
                                    "1 0 0 1 0 0 255 0 0 1 0 0 \n0 1 0 0 0 0 255 0 0 1 0 0 \n"
                                    "3 0 1 2 \n"));
  const MeshAttributes& a = mesh.attributes();
  EXPECT_THAT(a.normals, ::testing::Each(Eigen::Vector3d(0, 0, 1)));
  EXPECT_EQ(a.vertex_colors[0], Eigen::Vector4f(1, 0, 0.2F, 1));
  EXPECT_EQ(a.uvs[0], Eigen::Vector2d(0.25, 0.75));
  mesh.positions = {{0, 0, 0}, {0, 0, -1}, {0, 1, 0}};
  write_mesh(mesh, folder / "b.off");
  EXPECT_THAT(content_of(folder / "b.off"),
              ::testing::HasSubstr("\n0 0 0 255 0 51 255 1 0 0 0.25 0.75 \n"));
}

TEST(Off, VertexColoursNeedNotBeDeclared) {
  const auto attributes = [](const std::string& first, const std::string& second) {
    return read_off_text("OFF\n2 0 0\n0 0 0 " + first + "\n1 0 0 " + second + "\n").attributes();
  };
  EXPECT_THAT(attributes("255 0 51 255", "0 255 0 0").vertex_colors,
              ElementsAre(Eigen::Vector4f(1, 0, 0.2F, 1), Eigen::Vector4f(0, 1, 0, 0)));
  EXPECT_THAT(attributes("255 0 51", "0 255 0").vertex_colors,
              ElementsAre(Eigen::Vector4f(1, 0, 0.2F, 1), Eigen::Vector4f(0, 1, 0, 1)));
  EXPECT_THAT(attributes("0.5 0.5 0.25", "1 0 0").vertex_colors,
              ElementsAre(Eigen::Vector4f(0.5F, 0.5F, 0.25F, 1), Eigen::Vector4f(1, 0, 0, 1)));
  // In these files, the extra numbers are normals, or a vertex has none or too few.
  for (const auto& [first, second] : {std::pair("0 0 1", "0.6 0.8 0"), std::pair("0 -5 0", "1 5 1"),
                                      std::pair("255 0 0", ""), std::pair("0.5 0.5", "1 0")}) {
    const MeshAttributes other = attributes(first, second);
    EXPECT_TRUE(other.vertex_colors.empty()) << first;
    EXPECT_THAT(other.uneditable, ElementsAre(::testing::StartsWith(
                                      "vertices with numbers that the header does not declare")));
  }
}

TEST(Off, FaceColoursMayBeMissingOnSomeFaces) {
  const Mesh mesh =
      read_off_text("OFF\n3 3 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2 # none\n3 0 1 2 0 1 0.5\n3 0 1 2\n");
  EXPECT_THAT(mesh.attributes().face_colors,
              ElementsAre(Eigen::Vector4f::Ones(), Eigen::Vector4f(0, 1, 0.5F, 1),
                          Eigen::Vector4f::Ones()));
}

TEST(Off, CommentsAreKept) {
  const Mesh mesh = read_off_text("OFF\n# made by hand\n1 0 0\n0 0 0\n# the end\n");
  EXPECT_THAT(mesh.attributes().comments, ElementsAre("made by hand", "the end"));
}

}  // namespace
}  // namespace lapwing
