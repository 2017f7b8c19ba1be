#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "io/gltf_sample.h"
#include "io/temporary_folder.h"
#include "lapwing/base/errors.h"
#include "lapwing/io/mesh_file.h"
#include "support/error_message.h"

namespace lapwing {
namespace {

using test::Square;
using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

// Files whose nodes all show one square.
class GltfScene : public ::testing::Test {
 protected:
  Mesh read(const std::string& name = "a.glb") const { return read_mesh(folder_ / name); }
  std::string message(const std::string& name = "a.glb") const {
    return error_message<InputError>([&] { read(name); });
  }
  // `members` are members of the document, `of_mesh` those of its mesh. Each ends in a comma.
  void write_file(const std::string& nodes, const std::string& members = "",
                  const std::string& of_mesh = "") const {
    const Square square;
    folder_.file("a.glb", square.sample.glb(members + R"("nodes":[)" + nodes +
                                            R"(],"materials":[{}],"meshes":[{)" + of_mesh +
                                            R"("primitives":[)" + square.primitive + "]}]"));
  }

  TemporaryFolder folder_;
};

TEST_F(GltfScene, AnObjectWithAScaleOfZeroIsLeftOutAndNamed) {
  write_file(R"({"mesh":0,"name":"A"},{"mesh":0,"name":"hidden","scale":[0,0,0]},)"
             R"({"mesh":0,"name":"flat","scale":[1,0,1]})");
  Mesh mesh = read();
  EXPECT_THAT(mesh.attributes().groups, ElementsAre("A"));
  EXPECT_THAT(reading_notes(mesh),
              ElementsAre(AllOf(HasSubstr("a.glb: 'hidden' and 'flat' have a scale of 0"),
                                HasSubstr("they are left out"))));
  mesh.positions[0].z() = 1.0;
  write_mesh(mesh, folder_ / "b.glb");
  EXPECT_EQ(read("b.glb").positions, mesh.positions);
  EXPECT_THAT(content_of(folder_ / "b.glb"), HasSubstr(R"("name":"hidden","scale":[0,0,0])"));
  EXPECT_THAT(reading_notes(read("a.glb#A")), IsEmpty());
  EXPECT_THAT(message("a.glb#flat"), HasSubstr("a.glb: 'flat' has a scale of 0"));
}

TEST_F(GltfScene, ObjectsOfOtherScenesAreNamed) {
  const std::string nodes = R"({"mesh":0,"name":"A"},{"mesh":0,"name":"B"},{"mesh":0,"name":"C"})";
  write_file(nodes, R"("scene":1,"scenes":[{"nodes":[0,2]},{"name":"Main","nodes":[1]}],)");
  EXPECT_THAT(read().attributes().groups, ElementsAre("B"));
  EXPECT_THAT(reading_notes(read()),
              ElementsAre(HasSubstr("only the scene 'Main' is read, not 'scene 0', so 'A' and 'C' "
                                    "are left out; to read an object outside the scene, name it: "
                                    "a.glb#A")));
  EXPECT_THAT(reading_notes(read("a.glb#C")), IsEmpty());
  write_file(nodes, R"("scenes":[{"nodes":[0,1,2]},{"nodes":[1]}],)");
  EXPECT_THAT(reading_notes(read()), IsEmpty()) << "the first scene shows all objects";
}

TEST_F(GltfScene, MorphWeightsThatAreNotShownAreNamedAndKept) {
  write_file(R"({"mesh":0,"name":"A"},{"mesh":0,"name":"B","weights":[0,1]},)"
             R"({"mesh":0,"name":"C","weights":[0,0]})",
             "", R"("weights":[0.5,0.25],)");
  Mesh mesh = read();
  EXPECT_THAT(reading_notes(mesh), ElementsAre(HasSubstr("a.glb: 'A' and 'B' are read without the "
                                                         "morph weights 0.5, 0.25, 1, because")));
  mesh.positions[0].z() = 1.0;
  write_mesh(mesh, folder_ / "b.glb");
  EXPECT_THAT(content_of(folder_ / "b.glb"),
              AllOf(HasSubstr(R"("weights":[0,1])"), HasSubstr(R"("weights":[0.5,0.25])")));
  EXPECT_THAT(reading_notes(read("a.glb#C")), IsEmpty());
}

TEST_F(GltfScene, OnlyRequiredExtensionsThatLeaveTheShapeAloneAreAccepted) {
  const auto requiring = [&](const std::string& extension) {
    write_file(R"({"mesh":0})", R"("extensionsRequired":[")" + extension + R"("],)");
  };
  for (const char* name : {"KHR_mesh_quantization", "KHR_texture_transform", "EXT_texture_webp",
                           "KHR_materials_unlit", "KHR_lights_punctual", "KHR_technique_webgl"}) {
    requiring(name);
    EXPECT_EQ(read().face_count(), 2U) << name;
  }
  requiring("EXT_of_nobody");
  EXPECT_THAT(message(), AllOf(HasSubstr("/extensionsRequired/0: the file requires the extension "
                                         "EXT_of_nobody, which is not supported; "),
                               HasSubstr("without this extension")));
}

TEST_F(GltfScene, AFileWithACompressedCopyOfItsDataIsReadButNotEdited) {
  write_file(R"({"mesh":0})", R"("extensionsUsed":["KHR_draco_mesh_compression"],)");
  Mesh mesh = read();
  write_mesh(mesh, folder_ / "b.glb");
  EXPECT_EQ(content_of(folder_ / "b.glb"), content_of(folder_ / "a.glb"));
  mesh.positions[0].z() = 1.0;
  EXPECT_THAT(error_message<InputError>([&] { write_mesh(mesh, folder_ / "b.glb"); }),
              AllOf(HasSubstr("/extensionsUsed/0: the file has a second copy of its data"),
                    HasSubstr("save another format")));
  write_mesh(mesh, folder_ / "b.obj");
}

TEST_F(GltfScene, OnlyExtensionsThatAConversionLosesAreReported) {
  write_file(R"({"mesh":0})",
             R"("extensionsUsed":["KHR_texture_transform","KHR_mesh_quantization",)"
             R"("KHR_materials_clearcoat"],)");
  EXPECT_THAT(write_mesh(read(), folder_ / "a.obj").not_carried,
              ElementsAre(HasSubstr("data of the extension KHR_materials_clearcoat (1)")));
}

}  // namespace
}  // namespace lapwing
