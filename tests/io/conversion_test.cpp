#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "io/gltf_sample.h"
#include "io/temporary_folder.h"
#include "lapwing/base/errors.h"
#include "lapwing/io/file_colors.h"
#include "lapwing/io/image.h"
#include "lapwing/io/mesh_file.h"
#include "lapwing/io/mesh_materials.h"
#include "lapwing/mesh/shapes.h"
#include "support/error_message.h"

namespace lapwing {
namespace {

namespace fs = std::filesystem;
using Eigen::Vector3f;
using ::testing::AllOf;
using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;
using ::testing::Optional;
using ::testing::SizeIs;

const Image kImage{2, 1, {10, 20, 30, 255, 200, 100, 50, 255}};

// An OBJ file with two groups. Each group has one triangle and one material.
const std::string kTwoGroups =
    "mtllib two.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 1 0.25\nvt 0 0\nvt 1 0\nvt 0 1\n"
    "g left\nusemtl red\nf 1/1 2/2 3/3\ng right\nusemtl skin\nf 2/2 4/1 3/3\n";

class Conversion : public ::testing::Test {
 protected:
  // Reads an OBJ file with this material library and writes it as `name`.
  WriteReport convert_obj(const std::string& library, const std::string& name) {
    folder_.file("two.mtl", library);
    return write_mesh(read_mesh(folder_.file("two.obj", kTwoGroups)), folder_ / name);
  }
  FileColors colors_of(const std::string& name) const {
    return read_file_colors(read_mesh(folder_ / name), folder_ / name);
  }

  TemporaryFolder folder_;
};

class ConversionToGltf : public Conversion, public ::testing::WithParamInterface<std::string> {};

TEST_P(ConversionToGltf, KeepsColorsImagesAndGroups) {
  folder_.file("skin.png", encode_png(kImage));
  const WriteReport report = convert_obj(
      "newmtl red\nKd 1 0 0\nnewmtl skin\nKd 0.5 0.5 0.5\nmap_Kd skin.png\n", GetParam());
  EXPECT_THAT(report.not_carried, IsEmpty());
  EXPECT_THAT(report.notes, IsEmpty());

  const Mesh mesh = read_mesh(folder_ / GetParam());
  EXPECT_THAT(mesh.attributes().groups, ElementsAre("left", "right"));
  EXPECT_THAT(mesh.attributes().face_groups, ElementsAre(0, 1));
  const FileColors colors = colors_of(GetParam());
  EXPECT_THAT(colors.notes, IsEmpty());
  ASSERT_THAT(colors.materials, SizeIs(2));
  EXPECT_EQ(colors.materials[0].name, "red");
  EXPECT_LT((*colors.materials[0].color - Vector3f(1, 0, 0)).norm(), 1e-6F);
  EXPECT_LT((*colors.materials[1].color - Vector3f(0.5F, 0.5F, 0.5F)).norm(), 1e-6F);
  ASSERT_THAT(colors.images, SizeIs(1));
  EXPECT_EQ(colors.images[colors.materials[1].image].rgba, kImage.rgba);
  // The sRGB value 0.5 is 0.2140 in linear light. The file needs metallicFactor because its default
  // is 1, which means metal.
  EXPECT_THAT(content_of(folder_ / GetParam()),
              AllOf(HasSubstr(R"("baseColorFactor":[1,0,0,1],"metallicFactor":0)"),
                    HasSubstr(R"("baseColorFactor":[0.21404)"), HasSubstr(R"("name":"left")")));
}

INSTANTIATE_TEST_SUITE_P(All, ConversionToGltf, ::testing::Values("a.glb", "a.gltf"));

TEST_F(Conversion, ImagesGoIntoAGlbAndStayBesideAGltf) {
  const std::string png = encode_png(kImage);
  folder_.file("skin.png", png);
  const std::string library = "newmtl skin\nmap_Kd skin.png\n";
  convert_obj(library, "a.glb");
  EXPECT_THAT(content_of(folder_ / "a.glb"), HasSubstr(png));
  convert_obj(library, "a.gltf");
  EXPECT_THAT(content_of(folder_ / "a.gltf"), HasSubstr(R"("uri":"skin.png")"));
  fs::create_directory(folder_ / "elsewhere");
  convert_obj(library, "elsewhere/a.gltf");
  EXPECT_EQ(content_of(folder_ / "elsewhere/skin.png"), png);
}

TEST_F(Conversion, AnImageNeverReplacesAnother) {
  folder_.file("skin.png", encode_png(kImage));
  fs::create_directory(folder_ / "there");
  folder_.file("there/skin.png", "another picture");
  for (int times = 0; times < 2; ++times) {
    convert_obj("newmtl skin\nmap_Kd skin.png\n", "there/a.gltf");
    EXPECT_EQ(content_of(folder_ / "there/skin.png"), "another picture");
    EXPECT_EQ(content_of(folder_ / "there/skin-1.png"), encode_png(kImage));
    EXPECT_FALSE(fs::exists(folder_ / "there/skin-2.png")) << "the same image is used again";
  }
}

TEST_F(Conversion, ImagesThatGltfCannotStoreBecomePng) {
  // This TGA file contains one blue pixel.
  std::string tga(18, '\0');
  tga[2] = 2;
  tga[12] = tga[14] = 1;
  tga[16] = 24;
  folder_.file("skin.tga", tga + std::string("\xFF\x00\x00", 3));
  EXPECT_THAT(convert_obj("newmtl skin\nmap_Kd skin.tga\n", "a.glb").not_carried, IsEmpty());
  const FileColors colors = colors_of("a.glb");
  ASSERT_THAT(colors.images, SizeIs(1));
  EXPECT_THAT(colors.images[0].rgba, ElementsAre(0, 0, 255, 255));
  EXPECT_THAT(content_of(folder_ / "a.glb"), HasSubstr("\x89PNG"));
}

TEST_F(Conversion, WhatMaterialsLoseIsReported) {
  folder_.file("skin.dds", "DDS of some kind");
  const WriteReport report = convert_obj(
      "newmtl red\nKd 1 0 0\nmap_Bump bumps.png\nnewmtl skin\nmap_Kd skin.dds\n", "a.glb");
  ASSERT_THAT(report.not_carried, SizeIs(2));
  EXPECT_THAT(report.not_carried[0], HasSubstr("images of materials other than map_Kd (1)"));
  EXPECT_THAT(report.not_carried[1], HasSubstr("skin.dds: cannot read the file as PNG"));
}

TEST_F(Conversion, AMissingLibraryIsNoted) {
  const WriteReport report =
      write_mesh(read_mesh(folder_.file("two.obj", kTwoGroups)), folder_ / "a.glb");
  EXPECT_THAT(report.notes, ElementsAre(HasSubstr("material library 'two.mtl' is not beside")));
  EXPECT_THAT(content_of(folder_ / "a.glb"), HasSubstr(R"("materials":[{"name":"red"})"));
}

// The material is preserved when an OBJ is converted to GLB and back.
TEST_F(Conversion, AnObjComesBackFromAGlbWithItsMaterials) {
  const std::string png = encode_png(kImage);
  folder_.file("skin.png", png);
  convert_obj(
      "newmtl red\nKd 1 0 0\nd 0.5\nnewmtl skin\nKd 0 0 0\n"
      "map_Kd -s 2 4 -o 0.5 -0.25 -clamp on skin.png\n",
      "a.glb");
  // glTF measures v downwards. With v = 1 - v_gltf, 4 v - 0.25 = 1 - (4 v_gltf - 2.75).
  EXPECT_THAT(content_of(folder_ / "a.glb"),
              AllOf(HasSubstr(R"("offset":[0.5,-2.75],"scale":[2,4])"),
                    HasSubstr(R"("extensionsUsed":["KHR_texture_transform"])"),
                    HasSubstr(R"("samplers":[{"wrapS":33071,"wrapT":33071}],"textures":)"
                              R"([{"source":0,"sampler":0}])"),
                    HasSubstr(R"("alphaMode":"BLEND")")));
  fs::create_directory(folder_ / "back");
  EXPECT_THAT(write_mesh(read_mesh(folder_ / "a.glb"), folder_ / "back/b.obj").not_carried,
              IsEmpty());
  EXPECT_THAT(content_of(folder_ / "back/b.obj"),
              AllOf(HasSubstr("mtllib b.mtl\n"), HasSubstr("o left\nusemtl red\nf "),
                    HasSubstr("o right\nusemtl skin\nf "), Not(HasSubstr("\ng "))));
  EXPECT_EQ(content_of(folder_ / "back/skin.png"), png);
  std::vector<std::string> notes;
  const auto materials = read_material_library(folder_ / "back/b.mtl", notes);
  EXPECT_THAT(notes, IsEmpty());
  ASSERT_THAT(materials, SizeIs(2));
  EXPECT_THAT(materials[0].color, Optional(Vector3f(1, 0, 0)));
  EXPECT_EQ(materials[0].opacity, 0.5F);
  EXPECT_THAT(materials[1].color, Optional(Vector3f(1, 1, 1)))
      << "black would hide the image in glTF";
  EXPECT_EQ(materials[1].image, "skin.png");
  EXPECT_EQ(materials[1].uv_scale, Eigen::Vector2d(2, 4));
  EXPECT_EQ(materials[1].uv_offset, Eigen::Vector2d(0.5, -0.25));
  EXPECT_TRUE(materials[1].is_clamped);
}

TEST_F(Conversion, AnImageThatIsClampedAndRepeatedHasTwoTextures) {
  folder_.file("skin.png", encode_png(kImage));
  convert_obj("newmtl red\nmap_Kd -clamp on skin.png\nnewmtl skin\nmap_Kd skin.png\n", "a.glb");
  EXPECT_THAT(content_of(folder_ / "a.glb"),
              HasSubstr(R"("textures":[{"source":0,"sampler":0},{"source":0}],"images":[{"name")"));
}

TEST_F(Conversion, NamesThatAreNotUtf8AreReported) {
  const Mesh mesh = read_mesh(folder_.file(
      "a.obj",
      "v 0 0 0\nv 1 0 0\nv 0 1 0\ng T\xFCr\nusemtl Gr\xFCn\nf 1 2 3\ng M\u00F6we\nf 1 2 3\n"));
  EXPECT_THAT(write_mesh(mesh, folder_ / "a.glb").not_carried,
              ElementsAre(HasSubstr("names that are not UTF-8, 'T\\xFCr' and 'Gr\\xFCn': glTF")));
  EXPECT_THAT(write_mesh(mesh, folder_ / "b.obj").not_carried, IsEmpty());
}

// Returns a PLY file of two triangles. `uvs` declares two properties of the vertices.
std::string textured_ply(const std::string& comments, const std::string& uvs,
                         const std::string& numbers = "") {
  const std::string first = numbers.empty() ? "" : " 1";
  const std::string second = numbers.empty() ? "" : " 0";
  return "ply\nformat ascii 1.0\n" + comments +
         "element vertex 4\nproperty float x\nproperty float y\nproperty float z\n" + uvs +
         "element face 2\nproperty list uchar int vertex_indices\n" + numbers +
         "end_header\n0 0 0 0 0\n1 0 0 1 0\n0 1 0 0 1\n1 1 0 1 1\n3 0 1 2" + first + "\n3 1 3 2" +
         second + "\n";
}

TEST_F(Conversion, TexturesOfAPlyBecomeMaterials) {
  folder_.file("my skin.png", encode_png(kImage));
  for (const std::string uv : {"s t", "u v", "texture_u texture_v"}) {
    const std::size_t blank = uv.find(' ');
    const Mesh mesh = read_mesh(
        folder_.file("a.ply", textured_ply("comment TextureFile my skin.png\n",
                                           "property float " + uv.substr(0, blank) +
                                               "\nproperty float " + uv.substr(blank + 1) + "\n")));
    for (const std::string name : {"b.glb", "there/b.gltf", "there/b.obj"}) {
      fs::create_directory(folder_ / "there");
      const WriteReport report = write_mesh(mesh, folder_ / name);
      EXPECT_THAT(report.not_carried, IsEmpty()) << name;
      EXPECT_THAT(report.notes, IsEmpty()) << name;
      const FileColors colors = colors_of(name);
      EXPECT_THAT(colors.notes, IsEmpty()) << name;
      ASSERT_THAT(colors.images, SizeIs(1)) << name;
      EXPECT_EQ(colors.images[0].rgba, kImage.rgba);
      EXPECT_THAT(materials_of_faces(colors, read_mesh(folder_ / name)), ElementsAre(0, 0));
    }
    EXPECT_EQ(content_of(folder_ / "there/my skin.png"), encode_png(kImage));
    EXPECT_THAT(content_of(folder_ / "there/b.obj"),
                AllOf(HasSubstr("mtllib b.mtl\n"), HasSubstr("usemtl my skin.png\nf 1/1 2/2 3/3\n"),
                      Not(HasSubstr("TextureFile"))));
  }
}

TEST_F(Conversion, NumberedTexturesOfAPlyStayWithTheirFaces) {
  const Image other{1, 1, {1, 2, 3, 255}};
  folder_.file("a.png", encode_png(kImage));
  folder_.file("b.png", encode_png(other));
  const Mesh mesh = read_mesh(folder_.file(
      "a.ply", textured_ply("comment TextureFile a.png\ncomment TextureFile b.png\n",
                            "property float s\nproperty float t\n", "property int texnumber\n")));
  EXPECT_THAT(write_mesh(mesh, folder_ / "b.obj").not_carried, IsEmpty());
  const Mesh obj = read_mesh(folder_ / "b.obj");
  EXPECT_THAT(obj.attributes().materials, ElementsAre("b.png", "a.png"));
  const WriteReport back = write_mesh(obj, folder_ / "c.ply", {.encoding = Encoding::ascii});
  EXPECT_THAT(back.not_carried, ElementsAre(HasSubstr("names and colours of materials (2): PLY")));
  const FileColors colors = colors_of("c.ply");
  ASSERT_THAT(colors.materials, SizeIs(2));
  const std::vector<Index> of_faces = materials_of_faces(colors, read_mesh(folder_ / "c.ply"));
  EXPECT_EQ(colors.materials[of_faces[0]].name, "b.png");
  EXPECT_EQ(colors.materials[of_faces[1]].name, "a.png");
  EXPECT_THAT(colors.images, SizeIs(2));
}

TEST_F(Conversion, ImagesOfMaterialsBecomeTexturesOfAPly) {
  folder_.file("skin.png", encode_png(kImage));
  fs::create_directory(folder_ / "there");
  const WriteReport report =
      convert_obj("newmtl red\nKd 1 0 0\nnewmtl skin\nmap_Kd -s 2 2 skin.png\n", "there/a.ply");
  EXPECT_THAT(report.not_carried,
              ElementsAre(HasSubstr("names and colours of materials (2): PLY"),
                          HasSubstr("scales and offsets of images (1): PLY"), HasSubstr("groups")));
  EXPECT_THAT(report.notes, IsEmpty());
  EXPECT_EQ(content_of(folder_ / "there/skin.png"), encode_png(kImage));
  const FileColors colors = colors_of("there/a.ply");
  ASSERT_THAT(colors.materials, SizeIs(1));
  EXPECT_EQ(colors.materials[0].name, "skin.png");
  EXPECT_THAT(materials_of_faces(colors, read_mesh(folder_ / "there/a.ply")),
              ElementsAre(kNoIndex, 0));
}

TEST_F(Conversion, TexturesThatCannotBeCarriedAreReported) {
  const Mesh mesh =
      read_mesh(folder_.file("a.ply", textured_ply("comment TextureFile none.png\n",
                                                   "property float s\nproperty float t\n")));
  for (const std::string name : {"b.off", "b.stl"}) {
    EXPECT_THAT(write_mesh(mesh, folder_ / name).not_carried,
                Contains(HasSubstr("colours and images of materials (1)")));
  }
  for (const std::string name : {"b.ply", "b.obj", "b.glb"}) {
    EXPECT_THAT(write_mesh(mesh, folder_ / name).notes,
                Contains(HasSubstr("image 'none.png' is not beside")));
  }
  Mesh unknown = mesh;
  unknown.source = nullptr;
  EXPECT_THAT(write_mesh(unknown, folder_ / "b.glb").not_carried,
              Contains(HasSubstr("the source file of the mesh is unknown")));
}

TEST_F(Conversion, NumbersThatGltfCannotHoldAreLeftOutAndReported) {
  const Mesh mesh = read_mesh(
      folder_.file("a.obj",
                   "v 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0.25 0.5\nvt inf 0\nvt 0 nan\nvt 1e300 0\n"
                   "f 1/1 2/2 3/3\nf 1/1 3/4 2/1\n"));
  const WriteReport report = write_mesh(mesh, folder_ / "a.glb");
  EXPECT_THAT(
      report.not_carried,
      ElementsAre(HasSubstr("texture coordinates that are not finite, the first at vertex 1 "
                            "(3): GLB cannot store them")));
  const Mesh back = read_mesh(folder_ / "a.glb");
  for (const Eigen::Vector2d& uv : back.attributes().uvs) EXPECT_TRUE(uv.allFinite());
  EXPECT_THAT(back.attributes().uvs, Contains(Eigen::Vector2d(0.25, 0.5)));
}

TEST_F(Conversion, VerticesThatAreNotFiniteAreNotedOrRefused) {
  const Mesh mesh = read_mesh(
      folder_.file("a.obj", "v 0 0 0\nv 1 0 0\nv nan 1 0\nv 0 1 0\nv 0 0 inf\nf 1 2 3\nf 1 2 4\n"));
  for (const std::string name : {"b.ply", "b.off"}) {
    EXPECT_THAT(write_mesh(mesh, folder_ / name).notes,
                ElementsAre("non-finite vertices (2, the first is vertex 2): remove them with "
                            "`lapwing check MESH --fix OUT`"));
  }
  EXPECT_THAT(error_message<InputError>([&] { write_mesh(mesh, folder_ / "b.glb"); }),
              AllOf(HasSubstr("vertex 2 "), HasSubstr("`lapwing check MESH --fix OUT`")));
}

TEST_F(Conversion, VerticesThatMovedToInfinityAreRefusedInAChangedFile) {
  for (const std::string name : {"a.stl", "a.glb"}) {
    write_mesh(grid(2, 2), folder_ / name);
    Mesh mesh = read_mesh(folder_ / name);
    const std::string before = content_of(folder_ / name);
    mesh.positions[3].z() = std::numeric_limits<double>::infinity();
    EXPECT_THAT(error_message<InputError>([&] { write_mesh(mesh, folder_ / name); }),
                HasSubstr("vertex 3 "));
    EXPECT_EQ(content_of(folder_ / name), before);
  }
}

TEST_F(Conversion, AFullColourComponentStaysFullThroughLinearLight) {
  Mesh mesh = grid(1, 1);
  mesh.edit_attributes().vertex_colors.assign(4, Eigen::Vector4f(1, 0.5F, 0, 1));
  write_mesh(mesh, folder_ / "a.glb");
  for (const Eigen::Vector4f& color : read_mesh(folder_ / "a.glb").attributes().vertex_colors) {
    EXPECT_EQ(color[0], 1.0F);
    EXPECT_NEAR(color[1], 0.5F, 1e-7F);
  }
}

TEST_F(Conversion, ObjectsOfAnObjAreItsGroups) {
  const std::string corners = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";
  const Mesh objects =
      read_mesh(folder_.file("a.obj", corners + "o A\nf 1 2 3\no B\ng B\nf 1 2 3\n"));
  EXPECT_THAT(objects.attributes().groups, ElementsAre("A", "B"));
  EXPECT_THAT(objects.attributes().face_groups, ElementsAre(0, 1));
  EXPECT_THAT(objects.attributes().uneditable, IsEmpty());
  write_mesh(objects, folder_ / "b.obj", {.anew = true});
  EXPECT_THAT(content_of(folder_ / "b.obj"), HasSubstr("o A\nf 1 2 3\no B\nf 1 2 3\n"));

  const Mesh both =
      read_mesh(folder_.file("c.obj", corners + "o A\ng x\nf 1 2 3\no B\nf 1 2 3\ng x\nf 1 2 3\n"));
  EXPECT_THAT(both.attributes().groups, ElementsAre("A/x", "B", "B/x"));
  write_mesh(both, folder_ / "d.obj", {.anew = true});
  EXPECT_THAT(content_of(folder_ / "d.obj"), HasSubstr("g A/x\nf 1 2 3\ng B\nf 1 2 3\n"));
}

TEST_F(Conversion, LossesAreInOrderOfImportance) {
  const Mesh mesh = read_mesh(
      folder_.file("a.obj", "# text\n" + kTwoGroups + "f 1 2 4 3\nl 1 2\nv 16777217.5 0 0\n"));
  const WriteReport report = write_mesh(mesh, folder_ / "a.stl");
  ASSERT_THAT(report.not_carried, SizeIs(8));
  EXPECT_THAT(report.not_carried[0], HasSubstr("colours and images of materials (2): STL"));
  EXPECT_THAT(report.not_carried[1], HasSubstr("groups (2)"));
  EXPECT_THAT(report.not_carried[2], HasSubstr("line elements (1)"));
  EXPECT_THAT(report.not_carried[3], HasSubstr("exact positions"));
}

// Returns 20 x 20 squares with sides of 0.05, in UTM coordinates. There, the spacing of 32-bit
// floats is 0.5 for y and 1/32 for x.
Mesh far_grid() {
  Mesh mesh = grid(20, 20);
  for (Eigen::Vector3d& p : mesh.positions) {
    p = (p + Eigen::Vector3d(448262.25, 5411932.68, 115.0)).eval();
  }
  return mesh;
}

TEST_F(Conversion, TheLargestRoundingErrorIsComparedWithTheEdges) {
  const WriteReport report = write_mesh(far_grid(), folder_ / "far.stl");
  ASSERT_THAT(report.not_carried, Contains(HasSubstr("exact positions")));
  // Rounding changes y by up to 5411933.23 - 5411933 = 0.23, and x by up to 1/64. The edges have
  // lengths between 0.05 and 0.05 sqrt(2).
  const std::string& line = report.not_carried[0];
  double error = 0.0;
  double edges = 0.0;
  ASSERT_EQ(std::sscanf(line.c_str() + line.find("by up to"),
                        "by up to %lf, %lf times the mean edge length", &error, &edges),
            2)
      << line;
  EXPECT_NEAR(error, std::hypot(0.23, 1.0 / 64.0), 0.005);
  EXPECT_GT(edges, error / (0.05 * std::sqrt(2.0)));
  EXPECT_LT(edges, error / 0.05);
  EXPECT_THAT(line, HasSubstr("write .obj, .ply or .glb instead"));
}

TEST_F(Conversion, HarmlessRoundingIsNotMentioned) {
  Mesh mesh = grid(4, 4);
  for (Eigen::Vector3d& p : mesh.positions) p = (0.1 * p).eval();
  for (const char* name : {"a.stl", "a.glb", "a.ply"}) {
    EXPECT_THAT(write_mesh(mesh, folder_ / name).not_carried, IsEmpty()) << name;
  }
  EXPECT_THAT(content_of(folder_ / "a.glb"), Not(HasSubstr("translation")));
}

TEST_F(Conversion, AGlbOfAFarMeshHasTheOffsetInItsNodes) {
  EXPECT_THAT(write_mesh(far_grid(), folder_ / "far.glb").not_carried, IsEmpty());
  const Mesh far = far_grid();
  Mesh back = read_mesh(folder_ / "far.glb");
  ASSERT_EQ(back.face_count(), far.face_count());
  ASSERT_EQ(back.vertex_count(), far.vertex_count());
  for (std::size_t c = 0; c < far.face_vertices().size(); ++c) {
    EXPECT_LT(
        (back.positions[back.face_vertices()[c]] - far.positions[far.face_vertices()[c]]).norm(),
        1e-6);
  }
  back.positions[0].z() += 0.125;
  write_mesh(back, folder_ / "moved.glb");
  EXPECT_LT((read_mesh(folder_ / "moved.glb").positions[0] - back.positions[0]).norm(), 1e-6);
}

TEST_F(Conversion, AFarMeshOfBinaryFractionsReadsBackExactly) {
  Mesh mesh = grid(4, 4);
  for (Eigen::Vector3d& p : mesh.positions) {
    p = (p / 16.0 + Eigen::Vector3d(1048576, -3145728, 0.5)).eval();
  }
  write_mesh(mesh, folder_ / "far.glb");
  const Mesh back = read_mesh(folder_ / "far.glb");
  for (std::size_t c = 0; c < mesh.face_vertices().size(); ++c) {
    EXPECT_EQ(back.positions[back.face_vertices()[c]], mesh.positions[mesh.face_vertices()[c]]);
  }
}

// A triangle whose image is `bytes`. `texture` and `transform` are members of the texture and of
// the reference to it, and `members` those of the document, each with a comma.
std::string textured_triangle(const std::string& bytes, const std::string& texture,
                              const std::string& transform, const std::string& members) {
  test::GltfSample sample;
  sample.add(std::vector<float>{0, 0, 0, 1, 0, 0, 0, 1, 0}, 5126, "VEC3", 3);
  sample.add(std::vector<float>{0, 0, 1, 0, 0, 1}, 5126, "VEC2", 3);
  sample.add(std::vector<char>(bytes.begin(), bytes.end()), 5120, "SCALAR", bytes.size());
  return sample.glb(
      members +
      R"("nodes":[{"mesh":0}],"meshes":[{"primitives":[{"attributes":{"POSITION":0,)"
      R"("TEXCOORD_0":1},"material":0}]}],"materials":[{"name":"m","pbrMetallicRoughness":)"
      R"({"baseColorTexture":{)" +
      transform + R"("index":0}}}],"textures":[{)" + texture +
      R"(}],"images":[{"name":"skin","bufferView":2}])");
}

TEST_F(Conversion, AnImageOfAnotherFormatIsKeptAndNamedIfItIsNotShown) {
  const std::string webp = "RIFF1234WEBPVP8 ";
  const Mesh mesh = read_mesh(folder_.file(
      "a.glb", textured_triangle(webp, R"("extensions":{"EXT_texture_webp":{"source":0}})", "",
                                 R"("extensionsUsed":["EXT_texture_webp"],)"
                                 R"("extensionsRequired":["EXT_texture_webp"],)")));
  const FileColors colors = colors_of("a.glb");
  EXPECT_THAT(colors.notes, ElementsAre(HasSubstr("skin.webp: cannot read")));
  EXPECT_THAT(write_mesh(mesh, folder_ / "b.obj").not_carried, IsEmpty());
  EXPECT_THAT(content_of(folder_ / "b.mtl"), HasSubstr("map_Kd skin.webp\n"));
  EXPECT_EQ(content_of(folder_ / "skin.webp"), webp);
  EXPECT_THAT(write_mesh(mesh, folder_ / "b.gltf").not_carried,
              ElementsAre(HasSubstr("an image of a material: skin.webp")));
}

TEST_F(Conversion, WaysToShowAnImageThatMtlLacksAreNoted) {
  const std::string png = encode_png(kImage);
  const auto notes_for = [&](const std::string& transform, const std::string& sampler) {
    folder_.file("a.glb", textured_triangle(png, R"("source":0,"sampler":0)", transform,
                                            R"("samplers":[{)" + sampler + "}],"));
    return write_mesh(read_mesh(folder_ / "a.glb"), folder_ / "b.obj").notes;
  };
  EXPECT_THAT(notes_for("", R"("magFilter":9728)"), IsEmpty());
  EXPECT_THAT(notes_for("", R"("wrapS":33648,"wrapT":33648)"),
              ElementsAre(AllOf(HasSubstr("/samplers/0: the image of material 'm' is repeated"),
                                HasSubstr("REPEAT or CLAMP_TO_EDGE"))));
  EXPECT_THAT(notes_for("", R"("wrapS":33071)"), ElementsAre(HasSubstr("/samplers/0")));
  EXPECT_THAT(content_of(folder_ / "b.mtl"), HasSubstr("map_Kd skin.png"));
  EXPECT_THAT(notes_for(R"("extensions":{"KHR_texture_transform":{"rotation":1}},)", ""),
              ElementsAre(HasSubstr("the image of material 'm' is not rotated")));
}

TEST_F(Conversion, EmbeddedImagesOfAnyNameAreWrittenBesideTheObj) {
  const std::string png = encode_png(kImage);
  test::GltfSample sample;
  sample.add(std::vector<float>{0, 0, 0, 1, 0, 0, 0, 1, 0}, 5126, "VEC3", 3);
  sample.add(std::vector<float>{0, 0, 1, 0, 0, 1}, 5126, "VEC2", 3);
  const std::size_t at = sample.buffer().size();
  sample.add(std::vector<char>(png.begin(), png.end()), 5120, "SCALAR", png.size());
  const std::string primitive = R"({"attributes":{"POSITION":0,"TEXCOORD_0":1},"material":)";
  const fs::path file = folder_.file(
      "a.glb", sample.glb(R"("nodes":[{"mesh":0}],"meshes":[{"primitives":[)" + primitive + "0}," +
                          primitive +
                          R"(1}]}],"materials":[)"
                          R"({"name":"m","pbrMetallicRoughness":{"baseColorTexture":{"index":0}}},)"
                          R"({"name":"m","pbrMetallicRoughness":{"baseColorFactor":[0,1,0,1]}}],)"
                          R"("textures":[{"source":0}],)"
                          R"("images":[{"name":"../a/skin.png","bufferView":2}])"));
  ASSERT_EQ(content_of(file).substr(content_of(file).find("BIN") + 4 + at, png.size()), png);
  const WriteReport report = write_mesh(read_mesh(file), folder_ / "b.obj");
  EXPECT_THAT(report.not_carried, IsEmpty());
  EXPECT_EQ(content_of(folder_ / "_a_skin.png"), png);
  const FileColors colors = colors_of("b.obj");
  EXPECT_THAT(colors.notes, IsEmpty());
  ASSERT_THAT(colors.materials, SizeIs(2)) << "two materials of one name stay apart";
  EXPECT_EQ(colors.materials[1].name, "m (material 1)");
  EXPECT_THAT(colors.materials[1].color, Optional(Vector3f(0, 1, 0)));
  ASSERT_THAT(colors.images, SizeIs(1));
  EXPECT_EQ(colors.images[0].rgba, kImage.rgba);
}

}  // namespace
}  // namespace lapwing
