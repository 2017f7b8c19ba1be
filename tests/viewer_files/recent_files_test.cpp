#include "files/recent_files.h"

#include <thread>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "io/temporary_folder.h"
#include "support/environment.h"

namespace lapwing::viewer {
namespace {

namespace fs = std::filesystem;
using ::testing::ElementsAre;
using ::testing::IsEmpty;
using ::testing::SizeIs;

std::vector<std::string> names_of(const RecentFiles& recent) {
  std::vector<std::string> names;
  for (const auto& item : recent.items()) names.push_back(item.path.filename().string());
  return names;
}

class Recent : public ::testing::Test {
 protected:
  fs::path list() const { return folder_ / "state" / "recent-files"; }
  TemporaryFolder folder_;
};

TEST_F(Recent, FilesAreRememberedNewestFirstAndOnce) {
  RecentFiles recent(list());
  for (const char* name : {"a.ply", "b ü.ply", "c.ply", "a.ply"}) recent.add(folder_ / name);
  EXPECT_THAT(names_of(recent), ElementsAre("a.ply", "c.ply", "b ü.ply"));
  EXPECT_THAT(names_of(RecentFiles(list())), ElementsAre("a.ply", "c.ply", "b ü.ply"));
}

TEST_F(Recent, OnlySoManyAreKept) {
  RecentFiles recent(list());
  for (int k = 0; k < 30; ++k) recent.add(folder_ / (std::to_string(k) + ".ply"));
  EXPECT_THAT(recent.items(), SizeIs(RecentFiles::kMost));
  EXPECT_EQ(names_of(recent).front(), "29.ply");
}

TEST_F(Recent, WhatIsNotThereAnyMoreIsMarked) {
  RecentFiles recent(list());
  recent.add(folder_.file("there.ply", ""));
  recent.add(folder_ / "gone.ply");
  EXPECT_FALSE(recent.items()[0].is_there);
  EXPECT_TRUE(recent.items()[1].is_there);
  recent.clear();
  EXPECT_THAT(recent.items(), IsEmpty());
  EXPECT_THAT(RecentFiles(list()).items(), IsEmpty());
}

TEST_F(Recent, ViewersThatAddAtTheSameTimeLoseNothing) {
  std::vector<std::thread> viewers;
  for (int k = 0; k < 8; ++k) {
    viewers.emplace_back([&, k] {
      RecentFiles recent(list());
      recent.add(folder_ / (std::to_string(k) + ".ply"));
    });
  }
  for (std::thread& viewer : viewers) viewer.join();
  EXPECT_THAT(RecentFiles(list()).items(), SizeIs(8));
}

TEST_F(Recent, AFileThatIsNoListIsIgnored) {
  fs::create_directories(list().parent_path());
  using namespace std::string_view_literals;
  folder_.file("state/recent-files", "\177ELF\0\0\n\n/ok.ply\nrelative.ply\n/ok.ply"sv);
  RecentFiles recent(list());
  EXPECT_THAT(names_of(recent), ElementsAre("ok.ply"));
  recent.add("/new.ply");
  EXPECT_THAT(names_of(recent), ElementsAre("new.ply", "ok.ply"));
}

TEST_F(Recent, AFolderThatCannotBeWrittenIsNoError) {
  folder_.file("state", "a file where the folder should be");
  RecentFiles recent(list());
  recent.add("/a.ply");
  EXPECT_THAT(recent.items(), IsEmpty());
}

TEST_F(Recent, AreKeptInTheStateFolder) {
  const test::Environment home("HOME", "/home/ann");
  {
    const test::Environment state("XDG_STATE_HOME", "/state");
    EXPECT_EQ(recent_files_path(), "/state/lapwing/recent-files");
  }
  const test::Environment state("XDG_STATE_HOME", "");
  EXPECT_EQ(recent_files_path(), "/home/ann/.local/state/lapwing/recent-files");
}

}  // namespace
}  // namespace lapwing::viewer
