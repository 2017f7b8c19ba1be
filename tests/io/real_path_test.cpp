#include "lapwing/io/real_path.h"

#include <gtest/gtest.h>

#include "io/temporary_folder.h"
#include "lapwing/base/errors.h"

namespace lapwing {
namespace {

namespace fs = std::filesystem;

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

}  // namespace
}  // namespace lapwing
