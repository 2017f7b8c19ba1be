#include "files/folder_listing.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "io/temporary_folder.h"
#include "lapwing/base/cancellation.h"
#include "lapwing/base/errors.h"

namespace lapwing::viewer {
namespace {

namespace fs = std::filesystem;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

std::vector<std::string> names_of(const FolderListing& listing) {
  std::vector<std::string> names;
  for (const FolderEntry& entry : listing.entries) names.push_back(entry.name);
  return names;
}

ListingFilter meshes() {
  return {words_of(PathPurpose::save_mesh).kinds.front()};
}

class Listing : public ::testing::Test {
 protected:
  void SetUp() override {
    for (const char* name :
         {"part-10.ply", "part-2.ply", "Part-1.ply", "notes.md", ".hidden.ply"}) {
      folder_.file(name, "12345");
    }
    fs::create_directory(folder_ / "zoo");
    fs::create_directory(folder_ / "Animals");
    fs::create_directory(folder_ / ".git");
    fs::create_symlink("zoo", folder_ / "link");
    fs::create_symlink("nowhere", folder_ / "broken.ply");
  }
  TemporaryFolder folder_;
};

TEST_F(Listing, HasFoldersFirstThenFilesInTheOrderOfAPerson) {
  const FolderListing listing = list_folder(folder_.path(), meshes());
  EXPECT_THAT(listing.trouble, IsEmpty());
  EXPECT_THAT(names_of(listing),
              ElementsAre("Animals", "link", "zoo", "Part-1.ply", "part-2.ply", "part-10.ply"));
  EXPECT_EQ(listing.entries.back().bytes, 5U);
  EXPECT_NE(listing.entries.back().modified, fs::file_time_type());
}

TEST_F(Listing, ShowsHiddenAndOtherFilesWhereThatIsWanted) {
  EXPECT_THAT(names_of(list_folder(folder_.path(), {FileKind{"All", {}}, true})),
              ElementsAre(".git", "Animals", "link", "zoo", ".hidden.ply", "notes.md", "Part-1.ply",
                          "part-2.ply", "part-10.ply"));
  EXPECT_THAT(names_of(list_folder(folder_.path(), {meshes().kind, false, true})),
              ElementsAre("Animals", "link", "zoo"));
}

TEST_F(Listing, IsCancelledAtAnEntry) {
  const ProgressScope cancelled([](std::string_view, double) { return false; });
  const AskAtEveryCheck every;
  EXPECT_THROW(list_folder(folder_.path(), meshes()), Cancelled);
}

TEST_F(Listing, SaysWhyAFolderCannotBeRead) {
  const FolderListing listing = list_folder(folder_ / "nowhere", meshes());
  EXPECT_THAT(listing.trouble, HasSubstr("nowhere cannot be read: No such file"));
  EXPECT_THAT(listing.entries, IsEmpty());
}

TEST(ComesBefore, IsAStrictOrder) {
  for (const char* name : {"", "1", "a10", "größe"}) EXPECT_FALSE(comes_before(name, name)) << name;
  EXPECT_TRUE(comes_before("01", "1")) << "of one value: their bytes decide";
  EXPECT_FALSE(comes_before("1", "01"));
  EXPECT_TRUE(comes_before("a2", "a10"));
  EXPECT_TRUE(comes_before("A2", "a10"));
  EXPECT_FALSE(comes_before("a10", "A2"));
  EXPECT_TRUE(comes_before("a", "a1"));
  EXPECT_TRUE(comes_before("A", "a")) << "where nothing else differs";
  EXPECT_FALSE(comes_before("a", "A"));
}

}  // namespace
}  // namespace lapwing::viewer
