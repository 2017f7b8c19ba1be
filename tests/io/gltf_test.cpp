#include <algorithm>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

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

namespace fs = std::filesystem;
using test::GltfSample;
using test::Square;
using test::two_objects;
using test::without_last_face;
using ::testing::AllOf;
using ::testing::Contains;
using ::testing::HasSubstr;

std::string message_of(const fs::path& path) {
  return error_message<Error>([&] { read_mesh(path); });
}

// The rest of a document with one mesh, of these attributes and further members of its primitive.
std::string one_mesh(const std::string& attributes, const std::string& members = "") {
  return R"("nodes":[{"mesh":0}],"meshes":[{"primitives":[{"attributes":{)" + attributes + "}" +
         members + "}]}]";
}

const std::vector<float> kTrianglePoints{0, 0, 0, 1, 0, 0, 0, 1, 0};

TEST(Gltf, SplitVerticesAreOneWhereTheirPositionsAre) {
  const TemporaryFolder folder;
  const Square square;
  const Mesh mesh = read_mesh(folder.file("flag.glb", square.sample.glb(square.rest())));
  EXPECT_EQ(mesh.vertex_count(), 4U);
  ASSERT_EQ(mesh.face_count(), 2U);
  EXPECT_EQ(mesh.face(1)[0], mesh.face(0)[0]);
  EXPECT_EQ(mesh.attributes().normals.size(), 4U) << "equal normals of a vertex are one";
  EXPECT_EQ(mesh.attributes().uvs[0], Eigen::Vector2d(0.0, 0.0)) << "v runs upwards";
  EXPECT_EQ(mesh.attributes().materials, std::vector<std::string>{"cloth"});
  EXPECT_EQ(mesh.attributes().groups, std::vector<std::string>{"Flag"});
}

TEST(Gltf, WhatDoesNotMoveComesBackByteForByte) {
  const TemporaryFolder folder;
  const Square square;
  const std::string node = R"(,"rotation":[0,0,0.6,0.8],"scale":[2,3,-4],"translation":[1,2,3])";
  const std::string bytes = square.sample.glb(square.rest(node)) + "behind the end";
  const Mesh mesh = read_mesh(folder.file("flag.glb", bytes));
  write_mesh(mesh, folder / "again.glb");
  EXPECT_EQ(content_of(folder / "again.glb"), bytes);
}

TEST(Gltf, AByteOrderMarkIsReadAndKept) {
  const std::string mark = "\xEF\xBB\xBF";
  const Square square;
  const std::string uri = R"(,"uri":"flag.bin")";
  for (const bool is_binary : {false, true}) {
    const TemporaryFolder folder;
    folder.file("flag.bin", square.sample.buffer());
    const fs::path path =
        is_binary ? folder.file("flag.glb", square.sample.glb(square.rest(), mark))
                  : folder.file("flag.gltf", mark + square.sample.json(square.rest(), uri));
    Mesh mesh = read_mesh(path);
    mesh.positions[2] += Eigen::Vector3d(0.0, 0.0, 4.0);
    const fs::path moved = folder / ("moved" + path.extension().string());
    write_mesh(mesh, moved);
    EXPECT_THAT(content_of(moved), AllOf(HasSubstr(mark + "{"), HasSubstr(R"("max":[1,1,4])")));
    EXPECT_EQ(read_mesh(moved).positions, mesh.positions) << path;
  }
}

TEST(Gltf, NulsThatPadTheTextAreReadAndKept) {
  const TemporaryFolder folder;
  const Square square;
  std::string bytes = square.sample.glb(square.rest());
  const std::size_t size = square.sample.json(square.rest()).size();
  for (std::size_t k = 20 + size; k < 20 + (size + 3) / 4 * 4; ++k) bytes[k] = '\0';
  bytes.insert(20 + (size + 3) / 4 * 4, 4, '\0');
  bytes[8] = static_cast<char>(bytes[8] + 4);
  bytes[12] = static_cast<char>(bytes[12] + 4);
  Mesh mesh = read_mesh(folder.file("flag.glb", bytes));
  write_mesh(mesh, folder / "again.glb");
  EXPECT_EQ(content_of(folder / "again.glb"), bytes);
  mesh.positions[2] += Eigen::Vector3d(0.0, 0.0, 1234.0);  // makes the text longer
  write_mesh(mesh, folder / "moved.glb");
  EXPECT_EQ(read_mesh(folder / "moved.glb").positions, mesh.positions);
}

// The other program that reads the file could take what is behind the NUL.
TEST(Gltf, TextBehindANulIsRefused) {
  const TemporaryFolder folder;
  const Square square;
  const std::string text = square.sample.json(square.rest(), R"(,"uri":"flag.bin")");
  EXPECT_THAT(message_of(folder.file("a.gltf", text + std::string(1, '\0') + text)),
              HasSubstr("found a NUL byte"));
}

TEST(Gltf, PositionsNormalsTangentsAndBoundsFollow) {
  const TemporaryFolder folder;
  const Square square;
  const fs::path path = folder.file("flag.glb", square.sample.glb(square.rest()));
  Mesh mesh = read_mesh(path);
  for (Eigen::Vector3d& p : mesh.positions) p = {0.0, 2.0 * p.y(), p.x()};  // x upright
  write_mesh(mesh, path);

  const std::string bytes = content_of(path);
  EXPECT_THAT(bytes, AllOf(HasSubstr(R"("min":[0,0,0])"), HasSubstr(R"("max":[0,2,1])")));
  const Mesh again = read_mesh(path);
  EXPECT_EQ(again.positions, mesh.positions);
  for (const Eigen::Vector3d& normal : again.attributes().normals) {
    EXPECT_LT((normal - Eigen::Vector3d(-1, 0, 0)).norm(), 1e-6);
  }
  float tangent[4];
  const std::size_t tangents = bytes.find("BIN") + 4 + 6 * 24;
  std::memcpy(tangent, bytes.data() + tangents, sizeof tangent);
  EXPECT_EQ(std::vector<float>(tangent, tangent + 4), (std::vector<float>{0, 0, 1, -1}));
}

TEST(Gltf, ANodePutsItsMeshIntoTheWorld) {
  const TemporaryFolder folder;
  const Square square;
  const std::string node = R"(,"matrix":[0,2,0,0, -2,0,0,0, 0,0,2,0, 10,0,0,1])";
  const fs::path path = folder.file("flag.glb", square.sample.glb(square.rest(node)));
  Mesh mesh = read_mesh(path);
  EXPECT_EQ(mesh.positions[1], Eigen::Vector3d(10, 2, 0));
  mesh.positions[1] += Eigen::Vector3d(0, 0, 4);
  write_mesh(mesh, path);
  EXPECT_THAT(content_of(path), HasSubstr(R"("max":[1,1,2])"));
  EXPECT_EQ(read_mesh(path).positions, mesh.positions);
}

TEST(Gltf, AMirroredNodeShowsTheOtherSideOfItsTriangles) {
  const TemporaryFolder folder;
  const Square square;
  const Mesh mesh =
      read_mesh(folder.file("a.glb", square.sample.glb(square.rest(R"(,"scale":[-1,1,1])"))));
  const auto face = mesh.face(0);
  const Eigen::Vector3d normal = (mesh.positions[face[1]] - mesh.positions[face[0]])
                                     .cross(mesh.positions[face[2]] - mesh.positions[face[0]]);
  EXPECT_GT(normal.z(), 0.0) << "where the stored normal points, too";
}

TEST(Gltf, ObjectsAreChosenByName) {
  const TemporaryFolder folder;
  const Square square;
  const std::string rest =
      R"("nodes":[{"name":"Left","mesh":0},{"name":"Right","mesh":1,"translation":[5,0,0]}],)"
      R"("materials":[{}],"meshes":[{"primitives":[)" +
      square.primitive + R"(]},{"name":"Shape","primitives":[)" + square.primitive + "]}]";
  folder.file("two.glb", square.sample.glb(rest));
  EXPECT_EQ(read_mesh(folder / "two.glb").vertex_count(), 8U);
  EXPECT_EQ(read_mesh(folder / "two.glb#Right").positions[0].x(), 5.0);
  EXPECT_EQ(read_mesh(folder / "two.glb#Shape").vertex_count(), 4U);
  EXPECT_THAT(message_of(folder / "two.glb#Rigth"),
              AllOf(HasSubstr("there is no object 'Rigth'"), HasSubstr("\"Right\"?")));

  // Both objects share their numbers. The one that moves gets a copy.
  Mesh left = read_mesh(folder / "two.glb#Left");
  left.positions[0].z() = 1.0;
  write_mesh(left, folder / "moved.glb");
  EXPECT_EQ(read_mesh(folder / "moved.glb#Left").positions, left.positions);
  EXPECT_EQ(read_mesh(folder / "moved.glb#Right").positions,
            read_mesh(folder / "two.glb#Right").positions);
}

TEST(Gltf, SparsePositionsMoveWhereTheyStand) {
  const TemporaryFolder folder;
  GltfSample sample;
  sample.add(kTrianglePoints, 5126, "VEC3", 3);
  sample.add(std::vector<std::uint16_t>{2}, 5123, "SCALAR", 1);
  sample.add(std::vector<float>{0, 3, 0}, 5126, "VEC3", 1);
  const auto p = sample.add_accessor(
      R"("bufferView":0,"componentType":5126,"count":3,"type":"VEC3","min":[0,0,0],"max":[1,3,0],)"
      R"("sparse":{"count":1,"indices":{"bufferView":1,"componentType":5123},)"
      R"("values":{"bufferView":2}})");
  const fs::path path =
      folder.file("a.glb", sample.glb(one_mesh(R"("POSITION":)" + std::to_string(p))));
  Mesh mesh = read_mesh(path);
  EXPECT_EQ(mesh.positions[2], Eigen::Vector3d(0, 3, 0));
  mesh.positions[2] = {0, 7, 0};
  mesh.positions[1] = {2, 0, 0};
  write_mesh(mesh, path);
  EXPECT_EQ(read_mesh(path).positions, mesh.positions);
  EXPECT_THAT(content_of(path), HasSubstr(R"("max":[2,7,0])"));
}

TEST(Gltf, WholeNumbersBecomeFloatsWhereTheyMove) {
  const TemporaryFolder folder;
  GltfSample sample;
  sample.add(std::vector<std::int16_t>{0, 0, 0, 0, 32767, 0, 0, 0, 0, 32767, 0, 0}, 5122, "VEC3", 3,
             "stride:8");
  const auto p = sample.add_accessor(
      R"("bufferView":0,"componentType":5122,"normalized":true,"type":"VEC3","count":3)");
  const std::string rest = R"("nodes":[{"mesh":0,"scale":[10,10,10]}],"meshes":[{"primitives":[)"
                           R"({"attributes":{"POSITION":)" +
                           std::to_string(p) + "}}]}]";
  const fs::path path = folder.file("a.glb", sample.glb(rest));
  Mesh mesh = read_mesh(path);
  EXPECT_EQ(mesh.positions[1], Eigen::Vector3d(10, 0, 0));
  mesh.positions[1] = {0.3, 0, 0};
  write_mesh(mesh, path);
  EXPECT_NEAR(read_mesh(path).positions[1].x(), 0.3, 1e-7) << "by floats of its own";
  EXPECT_EQ(read_mesh(path).positions[2], mesh.positions[2]);
}

// A triangle with normalized integers as texture coordinates.
template <class Part, class Corner>
std::string triangle_in(int part_type, int corner_type) {
  GltfSample sample;
  const auto one = std::numeric_limits<Part>::max();
  const auto p = sample.add(kTrianglePoints, 5126, "VEC3", 3);
  const auto uv = sample.add(std::vector<Part>{0, one, one, one, 0, 0}, part_type, "VEC2", 3,
                             R"(,"normalized":true)");
  const auto i = sample.add(std::vector<Corner>{2, 0, 1}, corner_type, "SCALAR", 3);
  return sample.glb(
      one_mesh(R"("POSITION":)" + std::to_string(p) + R"(,"TEXCOORD_0":)" + std::to_string(uv),
               R"(,"indices":)" + std::to_string(i)));
}

TEST(Gltf, WholeNumbersOfEverySizeAreRead) {
  const TemporaryFolder folder;
  const Mesh expected =
      read_mesh(folder.file("a.glb", triangle_in<std::int16_t, std::uint16_t>(5122, 5123)));
  EXPECT_EQ(expected.positions[expected.face(0)[2]], Eigen::Vector3d(1, 0, 0));
  EXPECT_THAT(expected.attributes().uvs, Contains(Eigen::Vector2d(1, 0)));
  for (const std::string& bytes : {triangle_in<std::int8_t, std::uint8_t>(5120, 5121),
                                   triangle_in<std::uint8_t, std::uint8_t>(5121, 5121),
                                   triangle_in<std::uint16_t, std::uint32_t>(5123, 5125)}) {
    const Mesh mesh = read_mesh(folder.file("b.glb", bytes));
    EXPECT_EQ(mesh.faces().vertices, expected.faces().vertices);
    EXPECT_EQ(mesh.attributes().uvs, expected.attributes().uvs);
  }
}

TEST(Gltf, DataInTheTextIsWrittenThere) {
  const TemporaryFolder folder;
  GltfSample sample;
  const auto p = sample.add(kTrianglePoints, 5126, "VEC3", 3);
  const std::string rest = one_mesh(R"("POSITION":)" + std::to_string(p));
  // 36 bytes, in which two floats are 1.0F (00 00 80 3F) and the others 0, and two unused bytes.
  const std::string data = "AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAAAAA=";
  const fs::path path = folder.file(
      "a.gltf", sample.json(rest, R"(,"uri":"data:application/octet-stream;base64,)" + data + '"'));
  const std::string before = content_of(path);
  Mesh mesh = read_mesh(path);
  ASSERT_EQ(mesh.positions[1], Eigen::Vector3d(1, 0, 0));
  write_mesh(mesh, path);
  EXPECT_EQ(content_of(path), before);
  mesh.positions[1] = {0, 1, 0};
  mesh.positions[2] = {1, 0, 0};
  write_mesh(mesh, path);
  EXPECT_EQ(read_mesh(path).positions, mesh.positions);
  EXPECT_EQ(content_of(path).size(), before.size());
}

TEST(Gltf, ABufferOfItsOwnGoesWithTheFile) {
  const TemporaryFolder folder;
  GltfSample sample;
  const auto p = sample.add(kTrianglePoints, 5126, "VEC3", 3);
  const std::string rest = one_mesh(R"("POSITION":)" + std::to_string(p));
  const fs::path path = folder.file("a.gltf", sample.json(rest, R"(,"uri":"some%20numbers.bin")"));
  folder.file("some numbers.bin", sample.buffer());
  Mesh mesh = read_mesh(path);
  mesh.positions[1] = {4, 0, 0};
  write_mesh(mesh, folder / "b.gltf");
  EXPECT_EQ(content_of(folder / "some numbers.bin"), sample.buffer()) << "the input's";
  EXPECT_EQ(read_mesh(folder / "b.gltf").positions, mesh.positions);
  EXPECT_THAT(content_of(folder / "b.gltf"), HasSubstr("\"b.bin\""));
  write_mesh(mesh, path);
  EXPECT_EQ(read_mesh(path).positions, mesh.positions) << "in its place";
}

TEST(Gltf, OtherTrianglesTakeThePlaceOfTheOldOnes) {
  const TemporaryFolder folder;
  GltfSample sample;
  const std::string rest = two_objects(sample);
  const Mesh mesh = read_mesh(folder.file("a.glb", sample.glb(rest)));
  const WriteReport report =
      write_mesh(without_last_face(mesh), folder / "b.glb", {.original_file = mesh.source});
  EXPECT_THAT(report.not_carried, Contains(HasSubstr("the skin of 'Right'")));
  EXPECT_EQ(read_mesh(folder / "b.glb#Right").face_count(), 1U);
  EXPECT_EQ(read_mesh(folder / "b.glb#Right").attributes().face_materials.at(0), 1U);
  const std::string bytes = content_of(folder / "b.glb");
  EXPECT_THAT(bytes, HasSubstr(rest.substr(0, rest.find(R"({"name":"Right")"))));
  EXPECT_THAT(bytes, HasSubstr(R"({"name":"Right","mesh":1,"weights":[]})"));
  EXPECT_THAT(bytes, HasSubstr(sample.buffer())) << "all that was there, and what it got behind";
  EXPECT_EQ(read_mesh(folder / "b.glb#Left").positions, read_mesh(folder / "a.glb#Left").positions);
}

TEST(Gltf, AMorphTargetTellsWhatMoved) {
  const TemporaryFolder folder;
  GltfSample sample;
  Mesh mesh = read_mesh(folder.file("a.glb", sample.glb(two_objects(sample))));
  const Positions rest = mesh.positions;
  mesh.positions[1].z() = 4.0;
  write_mesh(mesh, folder / "b.glb", {.morph_targets = {{"up", mesh.positions}}});
  EXPECT_EQ(read_mesh(folder / "b.glb").positions, rest);
  EXPECT_THAT(content_of(folder / "b.glb"),
              AllOf(HasSubstr(R"("extras":{"targetNames":["up"]})"), HasSubstr(R"("max":[0,0,2])"),
                    HasSubstr(R"("sparse":{"count":1)")));
  EXPECT_THROW(write_mesh(mesh, folder / "b.obj", {.morph_targets = {{"up", mesh.positions}}}),
               InputError);
  mesh.positions = rest;
  EXPECT_THROW(write_mesh(mesh, folder / "b.glb", {.morph_targets = {{"up", mesh.positions}}}),
               InputError);
}

// A square with a morph target, its weight on mesh and node, and an animation of that weight.
std::string morphed_square(const std::string& extras) {
  Square square;
  GltfSample& sample = square.sample;
  const auto up = sample.add(std::vector<float>(18, 0.5F), 5126, "VEC3", 6);
  const auto times = sample.add(std::vector<float>{0, 1, 2}, 5126, "SCALAR", 3);
  const auto weights = sample.add(std::vector<float>{0, .25F, 1}, 5126, "SCALAR", 3);
  std::string primitive = square.primitive;
  primitive.insert(primitive.size() - 1, R"(,"targets":[{"POSITION":)" + std::to_string(up) + "}]");
  return sample.glb(R"("scenes":[{"nodes":[0]}],"nodes":[{"mesh":0,"weights":[0.5]}],)"
                    R"("materials":[{}],"meshes":[{"primitives":[)" +
                    primitive + R"(],"weights":[0.25])" + extras +
                    R"(}],"animations":[{"samplers":[{"input":)" + std::to_string(times) +
                    R"(,"output":)" + std::to_string(weights) +
                    R"(}],"channels":[{"sampler":0,"target":{"node":0,"path":"weights"}}]}])");
}

TEST(Gltf, AnotherMorphTargetHasAWeightWhereTheOthersHaveTheirs) {
  const TemporaryFolder folder;
  Mesh mesh = read_mesh(folder.file("a.glb", morphed_square("")));
  mesh.positions[1].z() = 4.0;
  write_mesh(mesh, folder / "b.glb", {.morph_targets = {{"smile", mesh.positions}}});
  const std::string text = content_of(folder / "b.glb");
  EXPECT_THAT(text, AllOf(HasSubstr(R"("weights":[0.5,0])"), HasSubstr(R"("weights":[0.25,0])"),
                          HasSubstr(R"("targetNames":["target 0","smile"])")));
  // The keys of the animation: the old weight and a 0, three times.
  std::string keys;
  for (const float number : {0.0F, 0.0F, 0.25F, 0.0F, 1.0F, 0.0F}) {
    keys.append(reinterpret_cast<const char*>(&number), sizeof number);
  }
  EXPECT_THAT(text, HasSubstr(keys));
}

TEST(Gltf, NamesOfMorphTargetsAreKeptAndStayApart) {
  const TemporaryFolder folder;
  Mesh mesh =
      read_mesh(folder.file("a.glb", morphed_square(R"(,"extras":{"targetNames":["up"]})")));
  mesh.positions[1].z() = 4.0;
  write_mesh(mesh, folder / "b.glb", {.morph_targets = {{"smile", mesh.positions}}});
  EXPECT_THAT(content_of(folder / "b.glb"), HasSubstr(R"("targetNames":["up","smile"])"));
  EXPECT_THROW(write_mesh(mesh, folder / "c.glb", {.morph_targets = {{"up", mesh.positions}}}),
               InputError);

  Mesh other = read_mesh(folder.file("d.glb", morphed_square(R"(,"extras":{"mine":1})")));
  other.positions[1].z() = 4.0;
  write_mesh(other, folder / "e.glb", {.morph_targets = {{"smile", other.positions}}});
  EXPECT_THAT(content_of(folder / "e.glb"),
              HasSubstr(R"("mine":1,"targetNames":["target 0","smile"])"));
}

TEST(Gltf, MorphTargetsAreReadBackAsTheyWereWritten) {
  const TemporaryFolder folder;
  Mesh mesh = read_mesh(folder.file("a.glb", morphed_square("")));
  EXPECT_TRUE(read_morph_targets(read_mesh(folder.file("plain.obj", "v 0 0 0\n"))).empty());
  const Positions rest = mesh.positions;
  std::vector<MorphTarget> targets{{"up", rest}, {"still", rest}, {"side", rest}};
  targets[0].positions[1].z() += 4.0;
  targets[2].positions[2].x() -= 0.5;
  write_mesh(mesh, folder / "b.glb", {.morph_targets = targets});
  EXPECT_THAT(content_of(folder / "b.glb"), HasSubstr(R"("weights":[0.5,0,0,0])"));
  const std::vector<MorphTarget> found = read_morph_targets(read_mesh(folder / "b.glb"));
  ASSERT_EQ(found.size(), 4U);
  EXPECT_EQ(found[0].name, "target 0");
  for (std::size_t v = 0; v < rest.size(); ++v) {
    EXPECT_EQ(found[0].positions[v], rest[v] + Eigen::Vector3d::Constant(0.5));
  }
  for (std::size_t t = 0; t < targets.size(); ++t) {
    EXPECT_EQ(found[t + 1].name, targets[t].name);
    EXPECT_EQ(found[t + 1].positions, targets[t].positions);
  }
}

TEST(Gltf, AMorphTargetOfAnotherNumberOfVerticesIsRefused) {
  const TemporaryFolder folder;
  GltfSample sample;
  const auto p = sample.add(kTrianglePoints, 5126, "VEC3", 3);
  const auto few = sample.add(std::vector<float>{0, 0, 1}, 5126, "VEC3", 1);
  const Mesh mesh = read_mesh(folder.file(
      "a.glb", sample.glb(R"("nodes":[{"mesh":0}],"meshes":[{"primitives":[{"attributes":)"
                          R"({"POSITION":)" +
                          std::to_string(p) + R"(},"targets":[{"POSITION":)" + std::to_string(few) +
                          "}]}]}]")));
  EXPECT_THAT(error_message<InputError>([&] { read_morph_targets(mesh); }),
              AllOf(HasSubstr("/meshes/0/primitives/0/targets/0"), HasSubstr("3 vertices")));
}

TEST(Gltf, AMorphTargetWhoseWeightsAreNoListIsRefused) {
  const TemporaryFolder folder;
  GltfSample sample;
  const auto p = sample.add(kTrianglePoints, 5126, "VEC3", 3);
  const std::string primitives = R"([{"attributes":{"POSITION":)" + std::to_string(p) + "}}]";
  Mesh mesh = read_mesh(folder.file(
      "a.glb", sample.glb(R"("nodes":[{"mesh":0}],"meshes":[{"weights":5,"primitives":)" +
                          primitives + "}]")));
  mesh.positions[1].z() = 4.0;
  EXPECT_THAT(error_message<InputError>([&] {
                write_mesh(mesh, folder / "b.glb", {.morph_targets = {{"up", mesh.positions}}});
              }),
              AllOf(HasSubstr("a.glb:1:"), HasSubstr("expected a list")));
}

TEST(Gltf, NormalsThatAMeshLacksAreSplitAtHardEdges) {
  const TemporaryFolder folder;
  const Mesh box = bar(2, 3, 1.0, 2.0);
  const auto largest_difference = [&](double feature_angle) {
    const fs::path path = folder.path() / "box.glb";
    write_mesh(box, path, {.feature_angle_degrees = feature_angle});
    const Mesh read = read_mesh(path);
    double largest = 0.0;
    for (std::size_t f = 0; f < read.face_count(); ++f) {
      const auto face = read.face(f);
      const Eigen::Vector3d& from = read.positions[face[0]];
      const Eigen::Vector3d normal =
          (read.positions[face[1]] - from).cross(read.positions[face[2]] - from).normalized();
      for (std::size_t k = 0; k < 3; ++k) {
        const Index stored = read.attributes().corner_normals[read.face_starts()[f] + k];
        largest = std::max(largest, (read.attributes().normals[stored] - normal).norm());
      }
    }
    return largest;
  };
  EXPECT_LT(largest_difference(kFeatureAngleDegrees), 1e-6);
  EXPECT_GT(largest_difference(91.0), 0.5) << "means over the edges";
}

TEST(Gltf, StoredNormalsAreNotSplit) {
  const TemporaryFolder folder;
  Mesh box = bar(1, 1, 1.0, 1.0);
  box.edit_attributes().normals.assign(box.vertex_count(), Eigen::Vector3d::UnitX());
  box.edit_attributes().has_vertex_normals = true;
  write_mesh(box, folder.path() / "box.ply");
  const Mesh stored = read_mesh(folder.path() / "box.ply");
  write_mesh(stored, folder.path() / "box.glb");
  const Mesh read = read_mesh(folder.path() / "box.glb");
  const MeshAttributes& a = read.attributes();
  ASSERT_EQ(a.normals.size(), box.vertex_count());
  for (std::size_t c = 0; c < a.corner_normals.size(); ++c) {
    const auto at = std::ranges::find(stored.positions, read.positions[read.face_vertices()[c]]);
    ASSERT_NE(at, stored.positions.end());
    const auto& normal = stored.attributes().normals[at - stored.positions.begin()];
    EXPECT_LT((a.normals[a.corner_normals[c]] - normal).norm(), 1e-6) << "corner " << c;
  }
}

TEST(Gltf, MadeAnewItReadsBack) {
  const TemporaryFolder folder;
  for (const char* name : {"a.glb", "a.gltf"}) {
    const Mesh sphere = icosphere(2);
    write_mesh(sphere, folder / name);
    const Mesh again = read_mesh(folder / name);
    ASSERT_EQ(again.face_count(), sphere.face_count());
    EXPECT_EQ(again.vertex_count(), sphere.vertex_count());
    for (std::size_t f = 0; f < again.face_count(); ++f) {
      for (std::size_t k = 0; k < 3; ++k) {
        const Eigen::Vector3d p = sphere.positions[sphere.face(f)[k]];
        EXPECT_EQ(again.positions[again.face(f)[k]], p.cast<float>().cast<double>());
      }
    }
  }
}

TEST(Gltf, WhatIsWrongIsNamed) {
  const TemporaryFolder folder;
  const auto message = [&](const std::string& bytes) {
    return message_of(folder.file("a.glb", bytes));
  };
  const Square square;
  const std::string good = square.sample.glb(square.rest());
  std::string old = good;
  old[4] = 1;
  EXPECT_THAT(message(old), HasSubstr("version 1 of GLB"));
  EXPECT_THAT(message(good.substr(0, 200)), HasSubstr("the header promises"));
  EXPECT_THAT(message("{}"), HasSubstr("not glTF 2.0"));
  EXPECT_THAT(message(R"({"asset":{"version":"2.0"},"extensionsRequired":)"
                      R"(["KHR_draco_mesh_compression"]})"),
              AllOf(HasSubstr("/extensionsRequired/0"), HasSubstr("without compression")));
  EXPECT_THAT(message(R"({"asset":{"version":"2.0"},"nodes":[{"children":[0]}]})"),
              HasSubstr("/nodes/0: this node is its own ancestor"));
  EXPECT_THAT(message(R"({"asset":{"version":"2.0"},"buffers":[{"byteLength":4,"uri":"no.bin"}]})"),
              AllOf(HasSubstr("/buffers/0/uri"), HasSubstr("there is no file 'no.bin'")));
  EXPECT_THAT(message(square.sample.glb(square.rest(R"(,"scale":[0,1,1])"))),
              HasSubstr("'Flag' has a scale of 0"));
  std::string beyond = good;
  beyond.replace(beyond.find(R"("byteLength":72)"), 15, R"("byteLength":71)");
  EXPECT_THAT(message(beyond), AllOf(HasSubstr("/accessors/0"), HasSubstr("beyond the end")));
}

}  // namespace
}  // namespace lapwing
