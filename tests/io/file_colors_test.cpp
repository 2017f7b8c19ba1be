#include "lapwing/io/file_colors.h"

#include <map>
#include <optional>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "io/gltf_sample.h"
#include "io/temporary_folder.h"
#include "lapwing/base/errors.h"
#include "lapwing/io/mesh_file.h"
#include "lapwing/io/uri.h"
#include "support/models.h"

namespace lapwing {
namespace {

using Eigen::Vector3f;
using ::testing::AllOf;
using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Optional;
using ::testing::SizeIs;

constexpr Index kNone = kNoIndex;

Image one_color(std::uint32_t width, std::uint32_t height, std::uint8_t value) {
  return {width, height, std::vector<std::uint8_t>(std::size_t{4} * width * height, value)};
}

// A triangle of material "a", then one of "b".
const std::string kTwoFaces =
    "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 1 0\nvt 0 0\nvt 1 0\nvt 0 1\n"
    "usemtl a\nf 1/1 2/2 3/3\nusemtl b\nf 2/2 4/3 3/1\n";

class FileColorsOf : public ::testing::Test {
 protected:
  FileColors read(std::string_view name, std::string_view text) {
    const auto path = folder_.file(name, text);
    mesh_ = read_mesh(path);
    return read_file_colors(mesh_, path);
  }
  FileColors read_obj(const std::string& libraries) { return read("a.obj", libraries + kTwoFaces); }
  void write_image(std::string_view name, const Image& image = one_color(2, 2, 255)) const {
    folder_.file(name, encode_png(image));
  }

  TemporaryFolder folder_;
  Mesh mesh_;
};

TEST_F(FileColorsOf, AnObjAreItsMaterialsWithTheirImages) {
  write_image("skin.png", one_color(3, 2, 90));
  folder_.file("a.mtl",
               "newmtl b\nKd 0 0 1\nnewmtl unused\nmap_Kd gone.png\n"
               "newmtl a\nKd 1 0 0\nmap_Kd -s 2 2 skin.png\n");
  const FileColors colors = read_obj("mtllib a.mtl\n");
  EXPECT_THAT(colors.notes, IsEmpty());
  ASSERT_THAT(colors.materials, SizeIs(2));
  EXPECT_THAT(colors.materials[0].color, Optional(Vector3f(1, 0, 0)));
  EXPECT_EQ(colors.materials[0].image, 0U);
  EXPECT_EQ(colors.materials[0].uv_scale, Eigen::Vector2d(2, 2));
  EXPECT_EQ(colors.materials[1].image, kNone);
  ASSERT_THAT(colors.images, SizeIs(1));
  EXPECT_EQ(colors.images[0].rgba, one_color(3, 2, 90).rgba);
  EXPECT_THAT(materials_of_faces(colors, mesh_), ElementsAre(0, 1));
}

TEST_F(FileColorsOf, LibrariesMayHaveBlanksInTheirNamesOrBeSeveral) {
  folder_.file("of my cat.mtl", "newmtl a\nKd 1 0 0\n");
  folder_.file("other.mtl", "newmtl b\nKd 0 0 1\n");
  for (const char* libraries : {"mtllib of my cat.mtl\nmtllib other.mtl\n",
                                "mtllib .\\Of my cat.mtl\nmtllib missing.mtl other.mtl\n"}) {
    const FileColors colors = read_obj(libraries);
    EXPECT_THAT(colors.materials, SizeIs(2)) << libraries;
    EXPECT_THAT(colors.notes, IsEmpty());
  }
}

TEST_F(FileColorsOf, ImagesAreRelativeToTheirLibraryOrTheMesh) {
  std::filesystem::create_directories(folder_ / "maps");
  write_image("maps/near.png");
  write_image("far.png");
  folder_.file("maps/a.mtl", "newmtl a\nmap_Kd near.png\nnewmtl b\nmap_Kd far.png\n");
  const FileColors colors = read_obj("mtllib maps/a.mtl\n");
  EXPECT_THAT(colors.notes, IsEmpty());
  EXPECT_THAT(colors.images, SizeIs(2));
}

TEST_F(FileColorsOf, ImagesAreFoundBelowTheMeshByPathsOfOtherSystems) {
  std::filesystem::create_directories(folder_ / "materials");
  std::filesystem::create_directories(folder_ / "textures");
  write_image("textures/near.png");
  write_image("textures/far.png");
  folder_.file("materials/a.mtl",
               "newmtl a\nmap_Kd ..\\textures\\near.png\n"
               "newmtl b\nmap_Kd C:\\proj\\Textures\\far.png -clamp on\n");
  const FileColors colors = read_obj("mtllib materials\\a.mtl\n");
  EXPECT_THAT(colors.notes, IsEmpty());
  EXPECT_THAT(colors.images, SizeIs(2));
}

TEST_F(FileColorsOf, FacesBeyondAClampedImageAreNoted) {
  write_image("skin.png");
  folder_.file("a.mtl", "newmtl a\nmap_Kd -clamp on -s 2 1 skin.png\nnewmtl b\nmap_Kd skin.png\n");
  EXPECT_THAT(
      read_obj("mtllib a.mtl\n").notes,
      ElementsAre(HasSubstr("faces of material 'a' are partly beyond their image (1), which "
                            "their file clamps; here it is repeated")));
}

TEST_F(FileColorsOf, NumbersOfAnOffThatAreNotShownAreNoted) {
  EXPECT_THAT(read("a.off", "OFF\n3 1 0\n0 0 0 0 0 1\n1 0 0 0 0 1\n0 1 0 0 0 1\n3 0 1 2 7\n").notes,
              ElementsAre(AllOf(HasSubstr("a.off has colour map indices (1), which are not shown"),
                                HasSubstr("as red green blue")),
                          AllOf(HasSubstr("the header does not declare (3), which are not shown"),
                                HasSubstr("begin the file with COFF"))));
}

TEST_F(FileColorsOf, OneImageOfManyMaterialsIsReadOnce) {
  write_image("skin.png");
  folder_.file("a.mtl", "newmtl a\nmap_Kd skin.png\nnewmtl b\nmap_Kd .\\SKIN.png\n");
  const FileColors colors = read_obj("mtllib a.mtl\n");
  EXPECT_THAT(colors.images, SizeIs(1));
  EXPECT_EQ(colors.materials[1].image, 0U);
}

TEST_F(FileColorsOf, WhatIsMissingIsANoteWithTheNextStep) {
  EXPECT_THAT(read_obj("").notes, ElementsAre(HasSubstr("no library (mtllib); export it again")));
  EXPECT_THAT(read_obj("mtllib gone.mtl\n").notes,
              ElementsAre(AllOf(HasSubstr("'gone.mtl' is not beside"), HasSubstr("put it there"))));
  folder_.file("b.mtl", "newmtl a\nKd 1 0 0\nmap_Kd gone.png\n");
  const FileColors colors = read_obj("mtllib b.mtl\n");
  EXPECT_THAT(colors.notes, ElementsAre(HasSubstr("material 'b' is not in the libraries"),
                                        HasSubstr("image 'gone.png' is not beside")));
  EXPECT_EQ(colors.materials[0].image, kNone);
  EXPECT_THAT(colors.materials[0].color, Optional(Vector3f(1, 0, 0)));
  EXPECT_THAT(materials_of_faces(colors, mesh_), ElementsAre(0, kNone));
}

TEST_F(FileColorsOf, TheLibraryOfTheMeshesNameStandsInForAMissingOne) {
  folder_.file("a.mtl", "newmtl a\nKd 1 0 0\nnewmtl b\n");
  const FileColors colors = read_obj("mtllib gone.mtl\n");
  EXPECT_THAT(colors.materials, SizeIs(2));
  EXPECT_THAT(colors.notes, ElementsAre(HasSubstr("a.mtl was read in its place")));
}

TEST_F(FileColorsOf, BrokenImagesAreNotesAndTheirMaterialsKeepTheirColor) {
  const std::string png = encode_png(one_color(40, 40, 90));
  folder_.file("cut.png", png.substr(0, png.size() / 2));
  folder_.file("text.png", "not an image");
  folder_.file("a.mtl", "newmtl a\nKd 1 0 0\nmap_Kd cut.png\nnewmtl b\nmap_Kd text.png\n");
  const FileColors colors = read_obj("mtllib a.mtl\n");
  EXPECT_THAT(colors.notes, SizeIs(2));
  EXPECT_THAT(colors.notes, Contains(HasSubstr("cut.png: cannot read the file as PNG")));
  EXPECT_THAT(colors.notes, Contains(HasSubstr("text.png: cannot read the file as PNG")));
  for (const FileMaterial& material : colors.materials) EXPECT_EQ(material.image, kNone);
}

TEST_F(FileColorsOf, FoldersAndUnreadableLibrariesAreNotes) {
  std::filesystem::create_directories(folder_ / "maps.mtl");
  EXPECT_THAT(read_obj("mtllib maps.mtl\n").notes, ElementsAre(HasSubstr("put it there")));
}

TEST_F(FileColorsOf, CornersWithoutTextureCoordinatesAreCounted) {
  write_image("skin.png");
  folder_.file("a.mtl", "newmtl a\nmap_Kd skin.png\n");
  const std::string triangle = "mtllib a.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl a\n";
  const FileColors none = read("b.obj", triangle + "f 1 2 3\n");
  EXPECT_THAT(none.notes, ElementsAre(HasSubstr("has no texture coordinates; the images")));
  EXPECT_THAT(none.images, IsEmpty());
  // The third index is beyond the file's two.
  const FileColors some =
      read("b.obj", triangle + "vt 0 0\nvt 1 0\nf 1/1 2/2 3/1\nf 1/1 2/2 3/7\n");
  EXPECT_THAT(some.notes,
              ElementsAre(HasSubstr("faces of material 'a' have no texture coordinates (1)")));
  EXPECT_THAT(mesh_.attributes().corner_uvs, ElementsAre(0, 1, 0, 0, 1, kNone));
  EXPECT_THAT(mesh_.attributes().uneditable,
              ElementsAre("references to missing texture coordinates (1)"));
}

TEST_F(FileColorsOf, LargeImagesAreHalvedUntilAllFit) {
  // Together 3 x 4096 x 3072: the first two are halved, and then all fit.
  write_image("1.png", one_color(4096, 3072, 90));
  for (const char* name : {"2.png", "3.png"}) {
    std::filesystem::copy_file(folder_ / "1.png", folder_ / name);
  }
  folder_.file("a.mtl", "newmtl a\nmap_Kd 1.png\nnewmtl b\nmap_Kd 2.png\nnewmtl c\nmap_Kd 3.png\n");
  const FileColors colors =
      read("a.obj", "mtllib a.mtl\n" + kTwoFaces + "usemtl c\nf 1/1 3/2 4/3\n");
  ASSERT_THAT(colors.images, SizeIs(3));
  std::size_t pixels = 0;
  for (const Image& image : colors.images) {
    EXPECT_EQ(image.rgba.size(), std::size_t{4} * image.width * image.height);
    pixels += image.rgba.size() / 4;
  }
  EXPECT_LE(4 * pixels, std::size_t{128} << 20U);
  EXPECT_EQ(colors.images[2].width, 4096U);
  EXPECT_EQ(colors.images[0].width, 2048U);
  EXPECT_THAT(colors.notes, ElementsAre(HasSubstr("more than 128 MiB together")));
}

TEST_F(FileColorsOf, ManyNotesAreCounted) {
  std::string faces = "mtllib a.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\n";
  for (int m = 0; m < 100; ++m) faces += "usemtl m" + std::to_string(m) + "\nf 1 2 3\n";
  folder_.file("a.mtl", "newmtl other\n");
  const FileColors colors = read("b.obj", faces);
  EXPECT_THAT(colors.notes, SizeIs(21));
  EXPECT_EQ(colors.notes.back(), "and 80 more like these");
}

TEST_F(FileColorsOf, APlyAreTheTexturesOfItsComments) {
  write_image("first.png");
  write_image("second.png", one_color(4, 4, 90));
  const std::string ply =
      "ply\nformat ascii 1.0\ncomment TextureFile first.png\ncomment TextureFile second.png\n"
      "element vertex 3\nproperty float x\nproperty float y\nproperty float z\n"
      "property float s\nproperty float t\nelement face 3\n"
      "property list uchar int vertex_indices\nproperty int texnumber\nend_header\n"
      "0 0 0 0 0\n1 0 0 1 0\n0 1 0 0 1\n3 0 1 2 1\n3 0 1 2 0\n3 0 1 2 2\n";
  const FileColors colors = read("a.ply", ply);
  EXPECT_THAT(colors.notes, IsEmpty());
  EXPECT_THAT(colors.images, SizeIs(2));
  EXPECT_THAT(materials_of_faces(colors, mesh_), ElementsAre(1, 0, kNone));
}

// The expected colours of a mesh in Debian's packages. The table lists every mesh with colours.
struct ColoredModel {
  std::string name;
  bool vertices = false;
  bool faces = false;
  std::size_t materials = 0;
  std::size_t images = 0;
  std::string note;  ///< part of the only note; empty if all colours are read

  bool operator==(const ColoredModel&) const = default;
};

void PrintTo(const ColoredModel& m, std::ostream* out) {
  *out << m.name << ": vertices " << m.vertices << ", faces " << m.faces << ", materials "
       << m.materials << ", images " << m.images << ", note '" << m.note << "'";
}

constexpr const char* kNoLibrary = "no library (mtllib)";

const std::vector<ColoredModel> kColoredModels{
    {"box.obj", false, false, 0, 0, kNoLibrary},
    {"box_longline.obj", false, false, 0, 0, kNoLibrary},
    {"box_mat_with_spaces.obj", false, false, 1, 0, ""},
    {"box_without_lineending.obj", false, false, 0, 0, kNoLibrary},
    {"cactus.off", true, false, 0, 0, ""},
    {"colored_tetra.ply", true, true, 0, 0, ""},
    {"concave_polygon.obj", false, false, 1, 0, ""},
    {"cube_mtllib_after_g.obj", false, false, 1, 0,
     "cube_mtllib_after_g.mtl was read in its place"},
    {"cube_usemtl.obj", false, false, 2, 0, "material 'mtl3' is not in the libraries"},
    {"cube_with_vertexcolors.obj", true, false, 0, 0, ""},
    {"cube_with_vertexcolors_uni.obj", true, false, 0, 0, ""},
    {"dino.off", true, false, 0, 0, ""},
    {"empty_mat.obj", false, false, 0, 0, "does not assign materials of its library"},
    {"float-color.ply", true, false, 0, 0, ""},
    {"mesh_with_colors.off", true, true, 0, 0, ""},
    {"plane.off", true, false, 0, 0, ""},
    {"points.ply", true, false, 0, 0, ""},
    {"quint_tris.off", false, true, 0, 0, ""},
    {"regr01.obj", false, false, 12, 0, ""},
    {"regr_3429812.obj", false, false, 1, 0, ""},
    {"space_in_material_name.obj", false, false, 1, 0, ""},
    {"spider.obj", false, false, 4, 4, ""},
    {"testmixed.obj", false, false, 0, 0, kNoLibrary},
};

// Returns the colours of the file at `path` with all notes. Returns nothing if the file contains no
// colours or no mesh.
std::optional<ColoredModel> colored_model(const std::filesystem::path& path) {
  Mesh mesh;
  try {
    mesh = read_mesh(path);
  } catch (const Error&) {
    return {};
  }
  const MeshAttributes& a = mesh.attributes();
  ColoredModel model{path.filename().string(), !a.vertex_colors.empty(), !a.face_colors.empty()};
  const bool names_materials = !a.material_libraries.empty() || !a.materials.empty();
  if (!model.vertices && !model.faces && !names_materials) return {};
  const FileColors colors = read_file_colors(mesh, path);
  model.materials = colors.materials.size();
  model.images = colors.images.size();
  for (const std::string& note : colors.notes) model.note += note;
  return model;
}

TEST(FileColorsOfModels, AreReadOrANoteSaysWhyNot) {
  LAPWING_NEEDS_MODELS(files, "assimp");
  LAPWING_NEEDS_MODELS(more, "cgal");
  std::map<std::string, ColoredModel> found;
  for (const auto& folder : {files, more}) {
    for (const auto& path : folder) {
      if (const auto model = colored_model(path)) found[model->name] = *model;
    }
  }
  for (const ColoredModel& expected : kColoredModels) {
    ColoredModel model = found[expected.name];
    EXPECT_THAT(model.note, HasSubstr(expected.note)) << expected.name;
    EXPECT_EQ(model.note.empty(), expected.note.empty()) << model.note;
    model.note = expected.note;
    EXPECT_EQ(model, expected);
    found.erase(expected.name);
  }
  for (const auto& [name, model] : found) ADD_FAILURE() << "not listed: " << name;
}

// The file stores base colours in linear light. Images are read from inside the file and from
// files beside it.
TEST(FileColorsOfGltf, AreThoseOfItsMaterials) {
  const TemporaryFolder folder;
  write_png(folder / "bark.png", one_color(2, 2, 128));
  const std::string inside = encode_png(one_color(1, 1, 70));
  test::GltfSample sample;
  sample.add(std::vector<char>(inside.begin(), inside.end()), 5120, "SCALAR", inside.size());
  const auto points = sample.add(std::vector<float>{0, 0, 0, 1, 0, 0, 0, 1, 0}, 5126, "VEC3", 3,
                                 R"(,"min":[0,0,0],"max":[1,1,0])");
  const auto uv = sample.add(std::vector<float>{0, 0, 1, 0, 0, 1}, 5126, "VEC2", 3);
  std::string primitives;
  for (int material = 0; material < 4; ++material) {
    primitives +=
        (material > 0 ? R"(,{"attributes":{"POSITION":)" : R"({"attributes":{"POSITION":)") +
        std::to_string(points) + R"(,"TEXCOORD_0":)" + std::to_string(uv) + R"(},"material":)" +
        std::to_string(material) + "}";
  }
  const std::filesystem::path file = folder.file(
      "a.glb",
      sample.glb(R"("scenes":[{"nodes":[0]}],"nodes":[{"mesh":0}],"meshes":[{"primitives":[)" +
                 primitives +
                 R"(]}],"materials":[{"name":"red","pbrMetallicRoughness":)"
                 R"({"baseColorFactor":[1,0,0,1]}},{"name":"bark","pbrMetallicRoughness":)"
                 R"({"baseColorTexture":{"index":0}}},{"name":"in","pbrMetallicRoughness":)"
                 R"({"baseColorTexture":{"index":1}}},{"name":"none"}],)"
                 R"("textures":[{"source":0},{"source":1}],)"
                 R"("images":[{"uri":"bark.png"},{"bufferView":0,"mimeType":"image/png"}])"));
  const Mesh mesh = read_mesh(file);
  const FileColors colors = read_file_colors(mesh, file);
  ASSERT_THAT(colors.materials, SizeIs(4));
  EXPECT_EQ(colors.materials[0].name, "red");
  ASSERT_TRUE(colors.materials[0].color.has_value());
  EXPECT_LT((*colors.materials[0].color - Vector3f(1, 0, 0)).norm(), 1e-6F);
  ASSERT_THAT(colors.images, SizeIs(2));
  EXPECT_EQ(colors.materials[1].image, 0U);
  EXPECT_EQ(colors.materials[2].image, 1U);
  EXPECT_EQ(colors.images[1].rgba, one_color(1, 1, 70).rgba);
  EXPECT_FALSE(colors.materials[3].color.has_value());
  EXPECT_THAT(colors.notes, IsEmpty());
}

// A mesh with an image in a data: URI. Two nodes show the mesh, and one of them has two instances.
TEST(FileColorsOfGltf, InstancesHaveTheImageOfTheirMesh) {
  const TemporaryFolder folder;
  const std::string inside = encode_png(one_color(1, 1, 70));
  test::GltfSample sample;
  const auto points = sample.add(std::vector<float>{0, 0, 0, 1, 0, 0, 0, 1, 0}, 5126, "VEC3", 3,
                                 R"(,"min":[0,0,0],"max":[1,1,0])");
  const auto uv = sample.add(std::vector<float>{0, 0, 1, 0, 0, 1}, 5126, "VEC2", 3);
  const auto places = sample.add(std::vector<float>{0, 0, 1, 0, 0, 2}, 5126, "VEC3", 2);
  const std::filesystem::path file = folder.file(
      "a.glb",
      sample.glb(R"("scenes":[{"nodes":[0,1]}],"extensionsUsed":["EXT_mesh_gpu_instancing"],)"
                 R"("nodes":[{"mesh":0},{"mesh":0,"extensions":{"EXT_mesh_gpu_instancing":)"
                 R"({"attributes":{"TRANSLATION":)" +
                 std::to_string(places) +
                 R"(}}}}],"meshes":[{"primitives":[{"attributes":{"POSITION":)" +
                 std::to_string(points) + R"(,"TEXCOORD_0":)" + std::to_string(uv) +
                 R"(},"material":0}]}],"materials":[{"name":"in","pbrMetallicRoughness":)"
                 R"({"baseColorTexture":{"index":0}}}],"textures":[{"source":0}],)"
                 R"("images":[{"uri":"data:image/png;base64,)" +
                 encode_base64(inside) + R"("}])"));
  const Mesh mesh = read_mesh(file);
  const FileColors colors = read_file_colors(mesh, file);
  EXPECT_THAT(colors.notes, IsEmpty());
  ASSERT_THAT(colors.images, SizeIs(1));
  EXPECT_EQ(colors.images[0].rgba, one_color(1, 1, 70).rgba);
  EXPECT_THAT(materials_of_faces(colors, mesh), ElementsAre(0, 0, 0));
  EXPECT_THAT(mesh.attributes().corner_uvs, SizeIs(9));
}

}  // namespace
}  // namespace lapwing
