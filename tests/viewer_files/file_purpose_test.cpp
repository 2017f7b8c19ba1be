#include "files/file_purpose.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "io/temporary_folder.h"
#include "lapwing/io/mesh_format.h"

namespace lapwing::viewer {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

TEST(FilePurpose, MeshesAreWhatTheEngineReadsInEitherCase) {
  const FileKind& meshes = words_of(PathPurpose::save_mesh).kinds.front();
  for (const std::string_view extension : meshes.extensions) {
    EXPECT_NO_THROW(format_of("a" + std::string(extension))) << extension;
  }
  EXPECT_TRUE(meshes.holds("Hand.PLY"));
  EXPECT_FALSE(meshes.holds("hand.json"));
  EXPECT_FALSE(meshes.holds("ply"));
  EXPECT_TRUE(words_of(PathPurpose::open).kinds.front().holds("bend.json"));
}

TEST(FilePurpose, ANameWithoutExtensionGetsThatOfTheSuggestion) {
  EXPECT_EQ(with_extension("/a/hand", PathPurpose::save_mesh, "b.ply"), "/a/hand.ply");
  EXPECT_EQ(with_extension("/a/hand.v2", PathPurpose::save_mesh, "b.ply"), "/a/hand.v2.ply");
  EXPECT_EQ(with_extension("/a/hand.obj", PathPurpose::save_mesh, "b.ply"), "/a/hand.obj");
  EXPECT_EQ(with_extension("/a/hand.fbx", PathPurpose::save_mesh, "b.ply"), "/a/hand.fbx")
      << "a format that is not written is said, not hidden";
  EXPECT_EQ(with_extension("/a/bend", PathPurpose::save_recipe, "b.json"), "/a/bend.json");
  EXPECT_EQ(with_extension("/a/hand", PathPurpose::open, ""), "/a/hand");
}

TEST(FilePurpose, SaysWhatIsWrongWithAPathAndTheNextStep) {
  const TemporaryFolder folder;
  const auto mesh = folder.file("hand.obj", "v 0 0 0\n");
  const auto text = folder.file("notes.md", "");
  EXPECT_THAT(trouble_with(mesh, PathPurpose::open), IsEmpty());
  EXPECT_THAT(trouble_with(folder / "foot.obj", PathPurpose::open),
              AllOf(HasSubstr("There is no file"), HasSubstr("foot.obj")));
  EXPECT_THAT(trouble_with(text, PathPurpose::open),
              AllOf(HasSubstr("notes.md"), HasSubstr("obj")));
  EXPECT_THAT(trouble_with(folder.path(), PathPurpose::open), HasSubstr("is a folder"));
  EXPECT_THAT(trouble_with(folder / "new.ply", PathPurpose::save_mesh), IsEmpty());
  EXPECT_THAT(trouble_with(folder / "new.fbx", PathPurpose::save_mesh),
              HasSubstr("Choose a name that ends in glb"));
  EXPECT_THAT(trouble_with(folder / "no" / "new.ply", PathPurpose::save_mesh),
              HasSubstr("There is no folder"));
  EXPECT_THAT(trouble_with(folder.path(), PathPurpose::parts_folder), IsEmpty());
  EXPECT_THAT(trouble_with(mesh, PathPurpose::parts_folder), HasSubstr("no folder"));
}

}  // namespace
}  // namespace lapwing::viewer
