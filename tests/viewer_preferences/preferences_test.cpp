#include "preferences/preferences.h"

#include <fstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "io/temporary_folder.h"
#include "lapwing/base/errors.h"

namespace lapwing::viewer {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

class PreferencesTest : public ::testing::Test {
 protected:
  ReadPreferences read(const std::string& text) {
    std::ofstream(file_) << text;
    return read_preferences(file_);
  }

  TemporaryFolder folder_;
  std::filesystem::path file_ = folder_ / "viewer.json";
};

TEST_F(PreferencesTest, ComeBackAsTheyWereWritten) {
  const Preferences written{.theme = Theme::light,
                            .mouse = "Maya",
                            .unit = "mm",
                            .shows_guide = false,
                            .settles_while_dragging = false,
                            .uses_system_dialogs = false,
                            .sidebar_letters = 31.5,
                            .window_width = 1900,
                            .window_height = 1000,
                            .tool = "Brush",
                            .brush_radius_pt = 55.0};
  const auto file = folder_ / "not there yet" / "viewer.json";
  write_preferences(written, file);
  const ReadPreferences read = read_preferences(file);
  EXPECT_EQ(read.preferences, written);
  EXPECT_THAT(read.troubles, IsEmpty());
}

TEST_F(PreferencesTest, AreTheDefaultsWithoutAFile) {
  const ReadPreferences read = read_preferences(file_);
  EXPECT_EQ(read.preferences, Preferences());
  EXPECT_THAT(read.troubles, IsEmpty());
}

TEST_F(PreferencesTest, AFileThatIsNoJsonIsSaidAndLeftAside) {
  for (const char* text : {"", "theme = light", "[1, 2]", "{\"theme\": "}) {
    const ReadPreferences found = read(text);
    EXPECT_EQ(found.preferences, Preferences()) << text;
    EXPECT_THAT(found.troubles, ElementsAre(HasSubstr(file_.string()))) << text;
  }
}

TEST_F(PreferencesTest, AValueThatCannotBeIsSaidByItsNameAndTheRestIsTaken) {
  const ReadPreferences found =
      read(R"({"theme": "light", "sidebar_letters": 1e9, "window_width": "wide", "guide": 1})");
  Preferences expected;
  expected.theme = Theme::light;
  EXPECT_EQ(found.preferences, expected);
  EXPECT_THAT(found.troubles, ElementsAre(HasSubstr("guide"), HasSubstr("sidebar_letters"),
                                          HasSubstr("window_width")));
}

TEST_F(PreferencesTest, WhatAnotherVersionKeepsStaysInTheFile) {
  read(R"({"a_later_one": [1, 2], "theme": "light"})");
  write_preferences({}, file_);
  EXPECT_THAT(content_of(file_), HasSubstr("a_later_one"));
  EXPECT_EQ(read_preferences(file_).preferences, Preferences());
}

TEST_F(PreferencesTest, AFolderThatCannotBeMadeIsAnError) {
  std::ofstream(folder_ / "file") << "";
  try {
    write_preferences({}, folder_ / "file" / "viewer.json");
    FAIL();
  } catch (const IoError& error) {
    EXPECT_THAT(error.what(), HasSubstr("XDG_CONFIG_HOME"));
  }
}

}  // namespace
}  // namespace lapwing::viewer
