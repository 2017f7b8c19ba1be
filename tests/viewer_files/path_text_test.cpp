#include "files/path_text.h"

#include <chrono>

#include <gtest/gtest.h>

#include "io/temporary_folder.h"
#include "support/environment.h"

namespace lapwing::viewer {
namespace {

namespace fs = std::filesystem;

TEST(TypedPath, ATildeIsTheHomeFolder) {
  const test::Environment home("HOME", "/home/ann");
  EXPECT_EQ(path_of("~", "/shown"), "/home/ann");
  EXPECT_EQ(path_of("~/hand.ply", "/shown"), "/home/ann/hand.ply");
  EXPECT_EQ(path_of("~bob/hand.ply", "/shown"), "/shown/~bob/hand.ply")
      << "a file may be called so";
  EXPECT_EQ(with_tilde("/home/ann/a/hand.ply"), "~/a/hand.ply");
  EXPECT_EQ(with_tilde("/home/ann"), "~");
  EXPECT_EQ(with_tilde("/home/anna/hand.ply"), "/home/anna/hand.ply");
}

TEST(TypedPath, WhatIsNotAbsoluteIsInTheFolderThatIsShown) {
  EXPECT_EQ(path_of("hand.ply", "/shown"), "/shown/hand.ply");
  EXPECT_EQ(path_of("  a/../b/hand.ply ", "/shown"), "/shown/b/hand.ply");
  EXPECT_EQ(path_of("../hand.ply", "/shown/a"), "/shown/hand.ply");
  EXPECT_EQ(path_of("models/", "/shown"), "/shown/models");
  EXPECT_EQ(path_of("/tmp//x", "/shown"), "/tmp/x");
  EXPECT_EQ(path_of("/", "/shown"), "/");
}

class Completion : public ::testing::Test {
 protected:
  void SetUp() override {
    fs::create_directory(folder_ / "Models");
    folder_.file("arm-1.ply", "");
    folder_.file("arm-2.ply", "");
    folder_.file("größe.obj", "");
    folder_.file("größer.obj", "");
    folder_.file(".hidden", "");
    folder_.file("Models/hand.off", "");
  }
  std::string after(std::string_view typed) const { return completed(typed, folder_.path()); }

  TemporaryFolder folder_;
};

TEST_F(Completion, GoesAsFarAsThereIsOneWay) {
  EXPECT_EQ(after("a"), "arm-");
  EXPECT_EQ(after("arm-1"), "arm-1.ply");
  EXPECT_EQ(after("Models/h"), "Models/hand.off");
  EXPECT_EQ(after("x"), "x");
  EXPECT_EQ(after("nowhere/x"), "nowhere/x");
}

TEST_F(Completion, GoesIntoAFolderAndCorrectsTheCase) {
  EXPECT_EQ(after("mod"), "Models/");
  EXPECT_EQ(after(folder_.path().string() + "/Mod"), folder_.path().string() + "/Models/");
}

TEST_F(Completion, KnowsLettersOfSeveralBytes) {
  EXPECT_EQ(after("gr"), "größe");
}

TEST_F(Completion, HiddenNamesNeedTheirDot) {
  EXPECT_EQ(after(".h"), ".hidden");
  EXPECT_NE(after(""), ".");
}

TEST_F(Completion, KnowsTheHomeFolder) {
  const test::Environment home("HOME", folder_.path());
  EXPECT_EQ(after("~"), "~/");
  EXPECT_EQ(after("~/Mod"), "~/Models/");
}

TEST(FileWords, SizesHaveTwoDigitsAtLeastAboveAKilobyte) {
  EXPECT_EQ(size_in_words(0), "0 B");
  EXPECT_EQ(size_in_words(999), "999 B");
  EXPECT_EQ(size_in_words(1000), "1.0 KB");
  EXPECT_EQ(size_in_words(9940), "9.9 KB");
  EXPECT_EQ(size_in_words(9960), "10 KB");
  EXPECT_EQ(size_in_words(999499), "999 KB");
  EXPECT_EQ(size_in_words(999600), "1.0 MB");
  EXPECT_EQ(size_in_words(23456789), "23 MB");
}

TEST(FileWords, DatesAreSortable) {
  const auto now = std::filesystem::file_time_type::clock::now();
  const std::string words = date_in_words(now);
  EXPECT_EQ(words.size(), 16U);
  EXPECT_LT(date_in_words(now - std::chrono::hours(24 * 400)), words);
}

}  // namespace
}  // namespace lapwing::viewer
