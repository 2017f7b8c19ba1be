#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "io/gltf_sample.h"
#include "io/temporary_folder.h"
#include "lapwing/base/errors.h"
#include "lapwing/io/mesh_file.h"
#include "lapwing/mesh/shapes.h"
#include "support/environment.h"
#include "support/error_message.h"

namespace lapwing {
namespace {

using test::GltfSample;
using test::Square;
using test::two_objects;
using test::without_last_face;
using ::testing::AllOf;
using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

// A file whose nodes R and L, 3 to the right, show one mesh of a square.
class GltfInstances : public ::testing::Test {
 protected:
  Mesh read(const std::string& name = "two.glb") const { return read_mesh(folder_ / name); }
  void write_file(const std::string& nodes) const {
    const Square square;
    folder_.file("two.glb",
                 square.sample.glb(R"("nodes":[)" + nodes +
                                   R"(],"materials":[{}],"meshes":[{"name":"m","primitives":[)" +
                                   square.primitive + "]}]"));
  }
  void SetUp() override {
    write_file(R"({"name":"R","mesh":0},{"name":"L","mesh":0,"translation":[3,0,0]})");
  }

  TemporaryFolder folder_;
};

TEST_F(GltfInstances, NodesOfOneMeshAreTwoObjects) {
  const Mesh mesh = read();
  EXPECT_EQ(mesh.vertex_count(), 8U);
  EXPECT_EQ(mesh.face_count(), 4U);
  EXPECT_THAT(mesh.attributes().groups, ElementsAre("R", "L"));
  EXPECT_EQ(mesh.positions[4], mesh.positions[0] + Eigen::Vector3d(3, 0, 0));
  EXPECT_EQ(read("two.glb#L").positions[0].x(), 3.0);
  EXPECT_EQ(read("two.glb#m").vertex_count(), 8U) << "all objects of that mesh";

  const WriteReport report = write_mesh(mesh, folder_ / "two.obj");
  EXPECT_THAT(report.not_carried, Contains(HasSubstr("meshes that several nodes share (1)")));
  EXPECT_THAT(content_of(folder_ / "two.obj"), AllOf(HasSubstr("o R\n"), HasSubstr("o L\n")));
  EXPECT_EQ(read("two.obj").positions, mesh.positions);
}

TEST_F(GltfInstances, ObjectsWithoutOrWithEqualNamesStayApart) {
  write_file(R"({"mesh":0},{"mesh":0,"translation":[3,0,0]},{"name":"m","mesh":0})");
  EXPECT_THAT(read().attributes().groups, ElementsAre("m", "m (node 1)", "m (node 2)"));
  EXPECT_EQ(read("two.glb#m (node 1)").positions[0].x(), 3.0);
}

TEST_F(GltfInstances, AnEditOfOneMovesTheOthersAndSaysSo) {
  for (const char* chosen : {"two.glb#L", "two.glb"}) {
    Mesh mesh = read(chosen);
    mesh.positions.back() += Eigen::Vector3d(0, 0, 4);
    const WriteReport report = write_mesh(mesh, folder_ / "moved.glb");
    const Mesh moved = read("moved.glb");
    EXPECT_EQ(moved.positions[3], Eigen::Vector3d(0, 1, 4));
    EXPECT_EQ(moved.positions[7], Eigen::Vector3d(3, 1, 4));
    EXPECT_THAT(report.notes,
                ElementsAre(HasSubstr("the mesh of 'L' is also shown by 'R', where the edit")));
  }
}

TEST_F(GltfInstances, ThoseThatMoveAlikeKeepTheirMesh) {
  Mesh mesh = read();
  mesh.positions[3].z() = mesh.positions[7].z() = 4.0;
  EXPECT_THAT(write_mesh(mesh, folder_ / "moved.glb").notes, ElementsAre());
  EXPECT_EQ(read("moved.glb").positions, mesh.positions);
  EXPECT_EQ(content_of(folder_ / "moved.glb").size(), content_of(folder_ / "two.glb").size());
}

TEST_F(GltfInstances, ThoseThatMoveDifferentlyGetTheirOwnMeshes) {
  write_file(R"({"name":"R","mesh":0},{"name":"L","mesh":0,"translation":[3,0,0]},)"
             R"({"name":"T","mesh":0,"translation":[0,9,0]})");
  for (const bool all_move : {false, true}) {
    Mesh mesh = read();
    mesh.positions[0].z() = 1.0;
    mesh.positions[5].z() = 2.0;
    if (all_move) mesh.positions[10].z() = 3.0;
    const WriteReport report = write_mesh(mesh, folder_ / "moved.glb");
    EXPECT_THAT(report.notes,
                ElementsAre(HasSubstr("showed one mesh but were edited differently")));
    const Mesh moved = read("moved.glb");
    EXPECT_EQ(moved.positions, mesh.positions);
    EXPECT_EQ(moved.attributes().groups, mesh.attributes().groups);
    EXPECT_EQ(moved.attributes().uvs, mesh.attributes().uvs);
  }
}

TEST_F(GltfInstances, AMorphTargetIsThatOfTheObjectThatMoved) {
  Mesh mesh = read();
  mesh.positions[5].z() = 2.0;
  write_mesh(mesh, folder_ / "up.glb", {.morph_target = "up"});
  EXPECT_THAT(content_of(folder_ / "up.glb"), HasSubstr(R"("max":[0,0,2])"));
  mesh.positions[0].z() = 1.0;
  EXPECT_THAT(error_message<InputError>(
                  [&] { write_mesh(mesh, folder_ / "up.glb", {.morph_target = "up"}); }),
              HasSubstr("'R' and 'L' show one mesh but moved differently"));
}

TEST_F(GltfInstances, AShortFileCannotShowAMeshTooOften) {
  const test::Environment limit("LAPWING_MOST_TRIANGLES", "9");
  EXPECT_EQ(read().face_count(), 4U);
  write_file(R"({"mesh":0},{"mesh":0},{"mesh":0},{"mesh":0})");
  EXPECT_THAT(error_message<Error>([&] { read(); }),
              AllOf(HasSubstr("the nodes that show a mesh again have"), HasSubstr("two.glb#m")));
}

// As two_objects, but both nodes show the first mesh and none has a skin.
TEST_F(GltfInstances, NewTrianglesOfOneAppearInAllOfThem) {
  GltfSample sample;
  std::string rest = two_objects(sample);
  rest.replace(rest.find(R"("mesh":1,"skin":0)"), 17, R"("mesh":0)");
  const Mesh mesh = read_mesh(folder_.file("a.glb", sample.glb(rest)));
  ASSERT_EQ(mesh.face_count(), 4U);
  const WriteReport report =
      write_mesh(without_last_face(mesh), folder_ / "b.glb", {.original_file = mesh.source});
  EXPECT_THAT(report.notes, ElementsAre(HasSubstr("the mesh of 'Right' is also shown by 'Left'")));
  EXPECT_EQ(read("b.glb").face_count(), 2U);

  Mesh both = without_last_face(mesh);
  both.positions[0].z() = 1.0;
  EXPECT_THAT(write_mesh(both, folder_ / "c.glb", {.original_file = mesh.source}).notes,
              ElementsAre(HasSubstr("'Left' and 'Right' showed one mesh but were edited")));
  EXPECT_EQ(read("c.glb").face_count(), 3U);
  EXPECT_EQ(read("c.glb#Right").face_count(), 1U);
  EXPECT_EQ(read("c.glb#Left").positions[0].z(), 1.0);
}

}  // namespace
}  // namespace lapwing
