#include "lapwing/io/named_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "io/temporary_folder.h"

namespace lapwing {
namespace {

namespace fs = std::filesystem;
using ::testing::Optional;

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
  EXPECT_THAT(find("maps/that/were/moved/Skin.png"), Optional(folder_ / "mesh/skin.png"));
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
