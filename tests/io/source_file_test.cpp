#include "lapwing/io/source_file.h"

#include <sstream>

#include <Eigen/Geometry>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "io/rich_mesh.h"
#include "io/temporary_folder.h"
#include "lapwing/base/errors.h"
#include "lapwing/io/mesh_file.h"
#include "lapwing/mesh/topology.h"

namespace lapwing {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

// An OBJ file with every kind of statement, in an unusual order and without a final line break.
const std::string kOddObj =
    "# by hand\r\nmtllib none.mtl\no thing\n\nv  0.0 0 -0\t0.5 0.5 0.5\nv 1e0 0 0 1 1 1 # second\n"
    "v 1.000 \\\n 1 0 0 0 0\nvt 0 0\nvt 1 1\nvn 0 0 1.0\nv 0 1 0 0 0 0\ns off\ng a b\n"
    "usemtl  wax\nf 1/1/1 2/2/1 3/1/1 4/2/1\nl 1 2\np 3\nf -1 -2 -3";

std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream in(text);
  for (std::string line; std::getline(in, line);) lines.push_back(line);
  return lines;
}

// Numbers of the lines that differ, from 1.
std::vector<std::size_t> changed_lines(const std::string& a, const std::string& b) {
  const auto before = lines_of(a);
  const auto after = lines_of(b);
  EXPECT_EQ(before.size(), after.size());
  std::vector<std::size_t> changed;
  for (std::size_t i = 0; i < std::min(before.size(), after.size()); ++i) {
    if (before[i] != after[i]) changed.push_back(i + 1);
  }
  return changed;
}

class Source : public ::testing::TestWithParam<Storage> {
 protected:
  // Writes a mesh with all attributes, reads the file and returns the mesh.
  Mesh write_and_read() {
    write_mesh(rich_mesh(), path(), {.encoding = GetParam().encoding});
    return read_mesh(path());
  }
  std::filesystem::path path() const { return folder_ / GetParam().name; }

  TemporaryFolder folder_;
};

TEST_P(Source, ComesBackByteForByteWhenNothingMoved) {
  const Mesh mesh = write_and_read();
  const std::string before = content_of(path());
  const auto copy = folder_ / ("copy-" + GetParam().name);
  EXPECT_THAT(write_mesh(mesh, copy).not_carried, ElementsAre());
  EXPECT_EQ(content_of(copy), before);
}

TEST_P(Source, HoldsTheNewPositionsAfterAnEditAndNothingElseChanged) {
  Mesh mesh = write_and_read();
  for (std::size_t v = 0; v < mesh.vertex_count(); v += 3) mesh.positions[v].z() += 0.5;
  write_mesh(mesh, path());
  const Mesh back = read_mesh(path());
  EXPECT_EQ(at_corners(back.positions, back.face_vertices()),
            at_corners(mesh.positions, mesh.face_vertices()));
  EXPECT_EQ(back.attributes().uvs, mesh.attributes().uvs);
  EXPECT_EQ(back.attributes().vertex_colors, mesh.attributes().vertex_colors);
  EXPECT_EQ(back.attributes().face_colors, mesh.attributes().face_colors);
  EXPECT_EQ(back.attributes().groups, mesh.attributes().groups);
  EXPECT_EQ(back.attributes().comments, mesh.attributes().comments);
}

TEST_P(Source, KeepsItsNormalsWhenTheWholeMeshIsTranslated) {
  Mesh mesh = write_and_read();
  for (auto& p : mesh.positions) p += Eigen::Vector3d(1, 2, 4);
  write_mesh(mesh, path());
  EXPECT_EQ(read_mesh(path()).attributes().normals, mesh.attributes().normals);
}

TEST_P(Source, TurnsItsNormalsWithTheMesh) {
  Mesh mesh = write_and_read();
  ASSERT_FALSE(mesh.attributes().normals.empty());
  const Eigen::Matrix3d turn =
      Eigen::AngleAxisd(0.7, Eigen::Vector3d(1, 2, 3).normalized()).toRotationMatrix();
  for (auto& p : mesh.positions) p = (turn * p).eval();
  write_mesh(mesh, path());
  const auto normals = read_mesh(path()).attributes().normals;
  ASSERT_EQ(normals.size(), mesh.attributes().normals.size());
  for (std::size_t i = 0; i < normals.size(); ++i) {
    EXPECT_LT((normals[i] - turn * mesh.attributes().normals[i]).norm(), 1e-6);
  }
}

TEST_P(Source, IsLeftWhenTheTopologyChanges) {
  Mesh mesh = write_and_read();
  std::swap(mesh.edit_faces().vertices[0], mesh.edit_faces().vertices[1]);
  write_mesh(mesh, path());
  const Mesh back = read_mesh(path());
  EXPECT_EQ(at_corners(back.positions, back.face_vertices()),
            at_corners(mesh.positions, mesh.face_vertices()));
}

INSTANTIATE_TEST_SUITE_P(All, Source, ::testing::ValuesIn(kStorages));
INSTANTIATE_TEST_SUITE_P(Gltf, Source,
                         ::testing::Values(Storage{"a.glb", Encoding::little_endian}));

class ObjSource : public ::testing::Test {
 protected:
  Mesh read(const std::string& text) const { return read_mesh(folder_.file("a.obj", text)); }
  std::string write(const Mesh& mesh) const {
    write_mesh(mesh, folder_ / "b.obj");
    return content_of(folder_ / "b.obj");
  }

  TemporaryFolder folder_;
};

TEST_F(ObjSource, OddFileComesBackByteForByte) {
  EXPECT_EQ(write(read(kOddObj)), kOddObj);
}

TEST_F(ObjSource, OnlyTheCoordinateThatMovedIsReplaced) {
  Mesh mesh = read(kOddObj);
  mesh.positions[1].x() += 1e-9;
  std::string expected = kOddObj;
  expected.replace(expected.find("1e0"), 3, "1.000000001");
  EXPECT_EQ(write(mesh), expected);
}

TEST_F(ObjSource, ColoursBehindAMovedVertexStay) {
  Mesh mesh = read(kOddObj);
  mesh.positions[0] = {7, 8, 0};
  EXPECT_THAT(write(mesh), HasSubstr("v  7 8 -0\t0.5 0.5 0.5\n"));
}

TEST_F(ObjSource, NormalsAreRecomputedAroundTheMovedVertexOnly) {
  const Mesh sphere = icosphere(2);
  std::string text;
  for (const auto& p : sphere.positions) {
    std::ostringstream lines;
    lines << "v " << p.transpose() << "\nvn 0 0 1\n";
    text += lines.str();
  }
  for (std::size_t f = 0; f < sphere.face_count(); ++f) {
    text += "f";
    for (const Index v : sphere.face(f)) {
      const std::string number = std::to_string(v + 1);
      text.append(" ").append(number).append("//").append(number);
    }
    text += "\n";
  }
  Mesh mesh = read(text);
  mesh.positions[40] += Eigen::Vector3d(0.3, 0.1, 0);
  // The area-weighted normal of a vertex depends only on the boundary of its one-ring.
  std::vector<std::size_t> expected{81};
  const Topology& topology = sphere.topology();
  for (const Index j : topology.rings[40]) expected.push_back(2 * j + 2);
  EXPECT_EQ(changed_lines(text, write(mesh)), expected);
}

TEST_F(ObjSource, HardEdgesStayHard) {
  // The two triangles share an edge, but each has separate normals.
  Mesh mesh = read(
      "v 0 0 0\nv 0 1 0\nv -1 0 0\nv 1 0 0\nvn 0 0 1\nvn 0 0 1\nf 1//1 2//1 3//1\n"
      "f 2//2 1//2 4//2\n");
  mesh.positions[2].z() = -1;
  mesh.positions[3].z() = -1;
  const MeshAttributes after = (write(mesh), read_mesh(folder_ / "b.obj").attributes());
  ASSERT_EQ(after.normals.size(), 2U);
  const double h = std::sqrt(0.5);
  EXPECT_LT((after.normals[0] - Eigen::Vector3d(-h, 0, h)).norm(), 1e-12);
  EXPECT_LT((after.normals[1] - Eigen::Vector3d(h, 0, h)).norm(), 1e-12);
}

// Returns two triangles with these normals. They touch along an edge but share no vertices.
std::string split_edge(const std::string& left, const std::string& right) {
  return "v 0 0 0\nv 0 1 0\nv -1 0 0\nv 0 0 0\nv 0 1 0\nv 2 0 0\nvn " + left + "\nvn " + right +
         "\nf 1//1 2//1 3//1\nf 5//2 4//2 6//2\n";
}

TEST_F(ObjSource, SeamWithEqualNormalsStaysSmooth) {
  Mesh mesh = read(split_edge("0 0 1", "0 0 1"));
  mesh.positions[2].z() = -1;
  write(mesh);
  const MeshAttributes after = read_mesh(folder_ / "b.obj").attributes();
  const auto normal_at = [&](std::size_t corner) {
    return after.normals[after.corner_normals[corner]];
  };
  EXPECT_EQ(normal_at(0), normal_at(4));
  EXPECT_EQ(normal_at(1), normal_at(3));
  // The area vectors are (-1, 0, 1) / 2 and (0, 0, 1).
  EXPECT_LT((normal_at(0) - Eigen::Vector3d(-1, 0, 3).normalized()).norm(), 1e-12);
  EXPECT_LT((normal_at(2) - Eigen::Vector3d(-1, 0, 1).normalized()).norm(), 1e-12);
  EXPECT_EQ(normal_at(5), Eigen::Vector3d(0, 0, 1));
}

TEST_F(ObjSource, SeamStaysHardWithOtherNormalsOrWhereItHasOpened) {
  const Eigen::Vector3d turned = Eigen::Vector3d(-1, 0, 1).normalized();
  Mesh hard = read(split_edge("0 0 1", "0.1 0 1"));
  hard.positions[2].z() = -1;
  write(hard);
  const std::vector<Eigen::Vector3d> after = read_mesh(folder_ / "b.obj").attributes().normals;
  EXPECT_LT((after[0] - turned).norm(), 1e-12);
  EXPECT_EQ(after[1], Eigen::Vector3d(0.1, 0, 1));
  Mesh opened = read(split_edge("0 0 1", "0 0 1"));
  opened.positions[2].z() = -1;
  for (const std::size_t v : {3, 4, 5}) opened.positions[v].x() += 0.1;
  write(opened);
  EXPECT_LT((read_mesh(folder_ / "b.obj").attributes().normals[0] - turned).norm(), 1e-12);
}

TEST_F(ObjSource, NormalSharedByVerticesThatNowDifferIsSplit) {
  // A flat strip of two quads with one normal for all; its right end is bent down.
  const std::string text =
      "v 0 0 0\nv 1 0 0\nv 2 0 0\nv 0 1 0\nv 1 1 0\nv 2 1 0\nvn 0 0 1\n# faces\n"
      "f 1//1 2//1 5//1 4//1\nf 2//-1 3//-1 6//-1 5//-1\n";
  Mesh mesh = read(text);
  mesh.positions[2] = {1, 0, -1};
  mesh.positions[5] = {1, 1, -1};
  const std::string after = write(mesh);
  EXPECT_THAT(after, HasSubstr("vn 0 0 1\nvn "));
  EXPECT_THAT(after, HasSubstr("# faces\nf 1//1 2//2 5//2 4//1\nf 2//2 3//3 6//3 5//2\n"));
  const MeshAttributes read_back = read_mesh(folder_ / "b.obj").attributes();
  const double h = std::sqrt(0.5);
  ASSERT_EQ(read_back.normals.size(), 3U);
  EXPECT_LT((read_back.normals[1] - Eigen::Vector3d(h, 0, h)).norm(), 1e-12);
  EXPECT_LT((read_back.normals[2] - Eigen::Vector3d(1, 0, 0)).norm(), 1e-12);
}

TEST_F(ObjSource, NormalsOfAClockwiseFileStayOnTheirSide) {
  Mesh mesh = read("v 0 0 0\nv 0 1 0\nv 1 0 0\nvn 0 0 1\nf 1//1 2//1 3//1\n");
  mesh.positions[2].z() = 1;
  write(mesh);
  const double h = std::sqrt(0.5);
  EXPECT_LT(
      (read_mesh(folder_ / "b.obj").attributes().normals[0] - Eigen::Vector3d(-h, 0, h)).norm(),
      1e-12);
}

TEST_F(ObjSource, ConversionSaysWhatOnlyTheSourceHolds) {
  const Mesh mesh = read(kOddObj);
  EXPECT_THAT(write_mesh(mesh, folder_ / "b.ply").not_carried,
              ::testing::Contains(HasSubstr("line elements (1)")));
}

TEST(PlySource, UnknownElementsAndPropertiesSurviveAnEdit) {
  const TemporaryFolder folder;
  const std::string text =
      "ply\nformat ascii 1.0\nobj_info kept\nelement vertex 3\nproperty float x\n"
      "property list uchar float weights\nproperty float y\nproperty float z\n"
      "element face 1\nproperty list uchar int vertex_indices\n"
      "element edge 1\nproperty int a\nend_header\n"
      "0 1 0.5 0 0\n1 0 0 0\n0 2 1 1 1 0\n3 0 1 2\n77\n";
  Mesh mesh = read_mesh(folder.file("a.ply", text));
  mesh.positions[2] = {0, 0.1, 0};
  write_mesh(mesh, folder / "b.ply");
  std::string expected = text;
  expected.replace(expected.find("0 2 1 1 1 0"), 11, "0 2 1 1 0.1 0");
  EXPECT_EQ(content_of(folder / "b.ply"), expected);
}

TEST(PlySource, CoordinateTooLargeForItsTypeIsRefused) {
  const TemporaryFolder folder;
  write_mesh(grid(1, 1), folder / "a.ply");
  Mesh mesh = read_mesh(folder / "a.ply");
  mesh.positions[0].x() = 1e300;
  EXPECT_THROW(write_mesh(mesh, folder / "a.ply"), InputError);
}

// The normals of a point cloud cannot be computed from faces.
TEST(SourceOfACloud, TakesNormalsThatTurnedWithoutMovingAPoint) {
  const TemporaryFolder folder;
  Mesh cloud;
  cloud.positions = {{1, 2, 3}, {4, 5, 6}};
  cloud.edit_attributes().normals = {{0, 0, 1}, {0, 1, 0}};
  cloud.edit_attributes().has_vertex_normals = true;
  for (const Encoding encoding : {Encoding::ascii, Encoding::big_endian}) {
    write_mesh(cloud, folder / "cloud.ply", {.encoding = encoding});
    Mesh turned = read_mesh(folder / "cloud.ply");
    turned.edit_attributes().normals[1] = {-1, 0, 0};
    write_mesh(turned, folder / "turned.ply");
    const Mesh again = read_mesh(folder / "turned.ply");
    EXPECT_EQ(again.positions, cloud.positions);
    EXPECT_EQ(again.attributes().normals, turned.attributes().normals);
  }
}

}  // namespace
}  // namespace lapwing
