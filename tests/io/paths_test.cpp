#include "lapwing/io/paths.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "io/temporary_folder.h"
#include "lapwing/base/errors.h"

namespace lapwing {
namespace {

namespace fs = std::filesystem;
using ::testing::Optional;

TEST(RealPath, FollowsLinksToWhatIsNotThereYet) {
  const TemporaryFolder folder;
  fs::create_symlink("../elsewhere.obj", folder / "link.obj");
  EXPECT_EQ(real_path(folder / "link.obj"),
            fs::canonical(folder.path()).parent_path() / "elsewhere.obj");
}

TEST(RealPath, RefusesLinksInACircle) {
  const TemporaryFolder folder;
  fs::create_symlink("b", folder / "a");
  fs::create_symlink("a", folder / "b");
  EXPECT_THROW(real_path(folder / "a"), IoError);
}

TEST(IsSameFile, WhateverThePathsAreWrittenLike) {
  const TemporaryFolder folder;
  folder.file("a.obj", "");
  fs::create_directory(folder / "sub");
  fs::create_hard_link(folder / "a.obj", folder / "hard.obj");
  fs::create_symlink("a.obj", folder / "soft.obj");
  EXPECT_TRUE(is_same_file(folder / "a.obj", folder / "sub/../a.obj"));
  EXPECT_TRUE(is_same_file(folder / "a.obj", folder / "hard.obj"));
  EXPECT_TRUE(is_same_file(folder / "a.obj", folder / "soft.obj"));
  EXPECT_TRUE(is_same_file(folder / "new.obj", folder / "./sub/../new.obj"));
  EXPECT_FALSE(is_same_file(folder / "a.obj", folder / "new.obj"));
}

TEST(IsInside, TheFolderAndWhatIsBelowIt) {
  const TemporaryFolder folder;
  fs::create_directories(folder / "box/in");
  fs::create_directory(folder / "box-and-more");
  EXPECT_TRUE(is_inside(folder / "box/a.obj", folder / "box"));
  EXPECT_TRUE(is_inside(folder / "box/in/a.obj", folder / "box/"));
  EXPECT_TRUE(is_inside(folder / "box/in/../a.obj", folder / "box/in/.."));
  EXPECT_FALSE(is_inside(folder / "a.obj", folder / "box"));
  EXPECT_FALSE(is_inside(folder / "box/../a.obj", folder / "box"));
  EXPECT_FALSE(is_inside(folder / "box-and-more/a.obj", folder / "box"));
  EXPECT_FALSE(is_inside("/etc/passwd", folder / "box"));
}

TEST(IsInside, LinksAreFollowed) {
  const TemporaryFolder folder;
  fs::create_directory(folder / "box");
  fs::create_symlink("/etc", folder / "box/etc");
  fs::create_symlink("../outside.obj", folder / "box/dangling.obj");
  EXPECT_FALSE(is_inside(folder / "box/etc/passwd", folder / "box"));
  EXPECT_FALSE(is_inside(folder / "box/dangling.obj", folder / "box"));
  fs::create_directory_symlink("box", folder / "other-name");
  EXPECT_TRUE(is_inside(folder / "box/a.obj", folder / "other-name"));
  EXPECT_TRUE(is_inside(folder / "other-name/a.obj", folder / "box"));
}

class NamedFile : public ::testing::Test {
 protected:
  void SetUp() override {
    fs::create_directories(folder_ / "mesh/textures");
    folder_.file("secret.png", "");
    folder_.file("mesh/skin.png", "");
    folder_.file("mesh/textures/bark of a tree.png", "");
  }
  std::optional<fs::path> find(std::string_view name) const {
    return find_named_file(folder_ / "mesh", name);
  }

  TemporaryFolder folder_;
};

TEST_F(NamedFile, IsRelativeToTheFolder) {
  EXPECT_THAT(find("skin.png"), Optional(folder_ / "mesh/skin.png"));
  EXPECT_THAT(find("./textures/bark of a tree.png"),
              Optional(folder_ / "mesh/textures/bark of a tree.png"));
  EXPECT_EQ(find("other.png"), std::nullopt);
}

TEST_F(NamedFile, NamesOfOtherSystemsAreUnderstood) {
  EXPECT_THAT(find(R"(.\Textures\Bark of a Tree.PNG)"),
              Optional(folder_ / "mesh/textures/bark of a tree.png"));
  EXPECT_THAT(find(R"(C:\Users\somebody\skin.png)"), Optional(folder_ / "mesh/skin.png"));
  EXPECT_THAT(find("C:skin.png"), Optional(folder_ / "mesh/skin.png"));
  EXPECT_THAT(find("maps/that/were/moved/Skin.png"), Optional(folder_ / "mesh/skin.png"));
}

TEST_F(NamedFile, TheEndOfANameMayLeadBelowTheFolder) {
  const auto bark = Optional(folder_ / "mesh/textures/bark of a tree.png");
  EXPECT_THAT(find(R"(C:\Users\somebody\mesh\textures\bark of a tree.png)"), bark);
  EXPECT_THAT(find("/home/somebody/Textures/bark of a tree.png"), bark);
  EXPECT_THAT(find(R"(..\textures\bark of a tree.png)"), bark);
  EXPECT_EQ(find(R"(C:\maps\bark of a tree.png)"), std::nullopt);
  // The longest end of the path that names an existing file is found.
  folder_.file("mesh/bark of a tree.png", "");
  EXPECT_THAT(find(R"(D:\textures\bark of a tree.png)"), bark);
  std::string deep;
  for (int k = 0; k < 100'000; ++k) deep += "a/";
  EXPECT_THAT(find(deep + "skin.png"), Optional(folder_ / "mesh/skin.png"));
}

TEST_F(NamedFile, SpellingDecidesBetweenNamesThatDifferInCase) {
  folder_.file("mesh/Skin.png", "");
  EXPECT_THAT(find("skin.png"), Optional(folder_ / "mesh/skin.png"));
  EXPECT_THAT(find("Skin.png"), Optional(folder_ / "mesh/Skin.png"));
  EXPECT_THAT(find("SKIN.png"), Optional(folder_ / "mesh/Skin.png")) << "the first by name";
}

TEST_F(NamedFile, NothingElsewhereIsFound) {
  const std::string outside = (folder_ / "secret.png").string();
  for (const std::string& name :
       {outside, std::string("../secret.png"), std::string("textures/../../secret.png"),
        std::string(R"(..\secret.png)")}) {
    EXPECT_EQ(find(name), std::nullopt) << name;
  }
  EXPECT_THAT(find("../../elsewhere/skin.png"), Optional(folder_ / "mesh/skin.png"));
}

TEST_F(NamedFile, FoldersAndEmptyNamesAreNone) {
  for (const char* name : {"", ".", "..", "/", "textures", "textures/", "\\"}) {
    EXPECT_EQ(find(name), std::nullopt) << name;
  }
}

}  // namespace
}  // namespace lapwing
