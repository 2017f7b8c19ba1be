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
  EXPECT_THAT(report.not_carried, Contains(HasSubstr("meshes that several objects share (1)")));
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
  write_mesh(mesh, folder_ / "up.glb", {.morph_targets = {{"up", mesh.positions}}});
  EXPECT_THAT(content_of(folder_ / "up.glb"), HasSubstr(R"("max":[0,0,2])"));
  mesh.positions[0].z() = 1.0;
  EXPECT_THAT(error_message<InputError>([&] {
                write_mesh(mesh, folder_ / "up.glb", {.morph_targets = {{"up", mesh.positions}}});
              }),
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

// A node at (0, 10, 0) with three instances of a square (EXT_mesh_gpu_instancing). The second is
// turned by 180 degrees about z, and the third has twice the size.
class GltfGpuInstances : public GltfInstances {
 protected:
  void SetUp() override { write_instanced(false); }

  void write_instanced(bool has_hidden) const {
    Square square;
    const auto moves =
        square.sample.add(std::vector<float>{0, 0, 0, 3, 0, 0, 6, 0, 1}, 5126, "VEC3", 3);
    const auto turns =
        square.sample.add(std::vector<std::int8_t>{0, 0, 0, 127, 0, 0, 127, 0, 0, 0, 0, 127}, 5120,
                          "VEC4", 3, R"(,"normalized":true)");
    const float size = has_hidden ? 0.0F : 2.0F;
    const auto scales =
        square.sample.add(std::vector<float>{1, 1, 1, 1, 1, 1, size, size, size}, 5126, "VEC3", 3);
    folder_.file(
        "two.glb",
        square.sample.glb(
            R"("extensionsUsed":["EXT_mesh_gpu_instancing"],"nodes":[{"name":"T","mesh":0,)"
            R"("translation":[0,10,0],"extensions":{"EXT_mesh_gpu_instancing":{"attributes":)"
            R"({"TRANSLATION":)" +
            std::to_string(moves) + R"(,"ROTATION":)" + std::to_string(turns) + R"(,"SCALE":)" +
            std::to_string(scales) + R"(}}}}],"materials":[{}],"meshes":[{"primitives":[)" +
            square.primitive + "]}]"));
  }
};

TEST_F(GltfGpuInstances, AreObjects) {
  const Mesh mesh = read();
  EXPECT_THAT(mesh.attributes().groups,
              ElementsAre("T (instance 0)", "T (instance 1)", "T (instance 2)"));
  ASSERT_EQ(mesh.vertex_count(), 12U);
  // The corner (1, 1, 0) of the square.
  EXPECT_LT((mesh.positions[2] - Eigen::Vector3d(1, 11, 0)).norm(), 1e-12);
  EXPECT_LT((mesh.positions[6] - Eigen::Vector3d(2, 9, 0)).norm(), 1e-12);
  EXPECT_LT((mesh.positions[10] - Eigen::Vector3d(8, 12, 1)).norm(), 1e-12);
  EXPECT_EQ(read("two.glb#T").vertex_count(), 12U);
  EXPECT_EQ(read("two.glb#T (instance 2)").positions[2], mesh.positions[10]);
  EXPECT_THAT(write_mesh(mesh, folder_ / "two.obj").not_carried,
              ElementsAre(HasSubstr("meshes that several objects share (1)")));
}

TEST_F(GltfGpuInstances, ShowAnEditOfOneOfThem) {
  Mesh mesh = read("two.glb#T (instance 2)");
  mesh.positions[2].z() += 4.0;
  EXPECT_THAT(write_mesh(mesh, folder_ / "moved.glb").notes,
              ElementsAre(HasSubstr("the mesh of 'T (instance 2)' is also shown by "
                                    "'T (instance 0)' and 'T (instance 1)'")));
  EXPECT_NEAR(read("moved.glb").positions[2].z(), 2.0, 1e-6);
  EXPECT_NEAR(read("moved.glb").positions[10].z(), 5.0, 1e-6);
}

TEST_F(GltfGpuInstances, CannotDiffer) {
  Mesh mesh = read();
  mesh.positions[2].z() += 1.0;
  mesh.positions[6].z() += 2.0;
  const auto message = [&](const Mesh& edited) {
    return error_message<InputError>(
        [&] { write_mesh(edited, folder_ / "b.glb", {.original_file = read().source}); });
  };
  EXPECT_THAT(message(mesh), AllOf(HasSubstr("is an instance of a node"),
                                   HasSubstr("edit one instance, which changes all of them")));
  EXPECT_THAT(message(without_last_face(mesh)), HasSubstr("is an instance of a node"));

  const Mesh one = read("two.glb#T (instance 1)");
  write_mesh(without_last_face(one), folder_ / "c.glb", {.original_file = one.source});
  EXPECT_EQ(read("c.glb").face_count(), 3U);
}

TEST_F(GltfGpuInstances, WithAScaleOfZeroAreLeftOut) {
  write_instanced(true);
  EXPECT_EQ(read().vertex_count(), 8U);
  EXPECT_THAT(reading_notes(read()), ElementsAre(HasSubstr("'T (instance 2)' has a scale of 0")));
}

TEST_F(GltfGpuInstances, HaveOneTransformEach) {
  const auto message = [&](const std::string& attributes) {
    Square square;
    const auto moves = square.sample.add(std::vector<float>{0, 0, 0, 3, 0, 0}, 5126, "VEC3", 2);
    const auto scales = square.sample.add(std::vector<float>{1, 1, 1}, 5126, "VEC3", 1);
    const auto empty =
        square.sample.add_accessor(R"("componentType":5126,"type":"VEC3","count":1000000000)");
    EXPECT_THAT((std::vector<std::size_t>{moves, scales, empty}), ElementsAre(4, 5, 6));
    folder_.file("bad.glb", square.sample.glb(
                                R"("nodes":[{"mesh":0,"extensions":{"EXT_mesh_gpu_instancing":)"
                                R"({"attributes":{)" +
                                attributes + R"(}}}}],"materials":[{}],"meshes":[{"primitives":[)" +
                                square.primitive + "]}]"));
    return error_message<InputError>([&] { read("bad.glb"); });
  };
  EXPECT_THAT(message(R"("TRANSLATION":4,"SCALE":5)"),
              HasSubstr("/SCALE: the accessor has 1 elements, but there are 2 instances"));
  EXPECT_THAT(message(R"("ROTATION":4)"), HasSubstr("expected an accessor of 4 numbers"));
  EXPECT_THAT(message(R"("TRANSLATION":6)"), HasSubstr("the accessor has no buffer view"));
}

}  // namespace
}  // namespace lapwing
