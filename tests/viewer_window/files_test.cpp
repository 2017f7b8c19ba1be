// A person chooses files in a real window, by real events.
#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "io/temporary_folder.h"
#include "lapwing/io/mesh_file.h"
#include "lapwing/mesh/shapes.h"
#include "support/gpu.h"
#include "support/keep_picture.h"
#include "viewer_window/drag_and_drop.h"
#include "viewer_window/window_test.h"

namespace lapwing {
namespace {

namespace fs = std::filesystem;
using Eigen::Vector2d;
using test::eventually;
using ::testing::HasSubstr;

// Mean difference of pictures that show the same.
constexpr double kSameScreen = 0.05;

class ChoosingFiles : public test::WindowTest {
 protected:
  void SetUp() override {
    WindowTest::SetUp();
    if (IsSkipped()) return;
    fs::create_directories(work() / "models");
    fs::create_directory(folder_ / "bin");
    write_mesh(rippled_cylinder(24, 41), work() / "tube.obj");
    write_mesh(icosphere(3), work() / "models" / "ball.obj");
  }

  void open_tube() {
    person_->open(work() / "tube.obj");
    ASSERT_TRUE(person_->waits_for_window()) << person_->errors();
    ASSERT_TRUE(is_open("tube.obj"));
    desktop_->settled_picture();
  }

  // Whether something is said in the colour of refusals.
  bool refuses() const {
    return eventually(kPatienceSeconds, [&] {
      const Image image = desktop_->picture();
      for (std::uint32_t y = 0; y < image.height; ++y) {
        for (std::uint32_t x = 0; x < image.width; ++x) {
          const auto pixel = image.pixel(x, y);
          const bool is_red = std::abs(pixel[0] - 255) < 8 && std::abs(pixel[1] - 143) < 8 &&
                              std::abs(pixel[2] - 133) < 8;
          if (is_red) return true;
        }
      }
      return false;
    });
  }

  // What the desktop's dialog does from now on.
  void put_zenity(const std::string& script) const {
    const fs::path program = folder_.file("bin/zenity", "#!/bin/sh\n" + script);
    fs::permissions(program, fs::perms::owner_all);
  }

  fs::path work() const { return folder_ / "work"; }
  fs::path ball() const { return work() / "models" / "ball.obj"; }
};

TEST_F(ChoosingFiles, APathTypedRightAfterTheKeyOpensThatFile) {
  open_tube();
  desktop_->xdotool("key ctrl+o type --args 1 --delay 0 '" + ball().string() + "' key Return");
  EXPECT_TRUE(is_open("ball.obj"));
  expect_quits_silently();
}

TEST_F(ChoosingFiles, NoKeyReachesThePictureBehind) {
  open_tube();
  person_->move_to({20, 400});
  const Image before = desktop_->settled_picture();
  const auto edited = person_->draft();
  person_->open_dialog("ctrl+o");
  keep_picture("file-browser");
  person_->type("ihm3 7.L");
  person_->keys("ctrl+a key Home key Delete key Left key BackSpace");
  person_->keys("Escape");
  EXPECT_TRUE(shows(before, kSameScreen));
  EXPECT_EQ(person_->draft(), edited);
  expect_quits_silently();
}

TEST_F(ChoosingFiles, TabCompletesAndRelativePathsBeginInTheFolderThatIsShown) {
  open_tube();
  person_->open_dialog("ctrl+o");
  // Letters and keys that come in one frame have no order there.
  const auto type_and_complete = [&](const std::string& text) {
    person_->type(text);
    desktop_->settled_picture();
    person_->keys("Tab");
    desktop_->settled_picture();
  };
  type_and_complete("mod");
  type_and_complete("b");
  person_->keys("Return");
  EXPECT_TRUE(is_open("ball.obj"));
  person_->open_dialog("ctrl+o");
  person_->type("~/work/tube.obj");
  person_->keys("Return");
  EXPECT_TRUE(is_open("tube.obj"));
  expect_quits_silently();
}

TEST_F(ChoosingFiles, DoubleClicksGoIntoAFolderAndOpenAFile) {
  open_tube();
  person_->open_dialog("ctrl+o");
  const auto double_click = [&](const Vector2d& pixel) {
    person_->move_to(pixel);
    desktop_->settled_picture();
    desktop_->xdotool("click --repeat 2 --delay 120 1");
    desktop_->settled_picture();
  };
  // The first row, wherever it is, is the folder, and in that the file.
  bool opened = false;
  for (double y = 226.0; y < 330.0 && !opened; y += 8.0) {
    double_click({620.0, y});
    double_click({620.0, y});
    opened = has_window("ball.obj");
  }
  EXPECT_TRUE(opened);
  expect_quits_silently();
}

TEST_F(ChoosingFiles, AnErrorKeepsWhatWasTyped) {
  open_tube();
  const fs::path later = work() / "later.obj";
  person_->open_dialog("ctrl+o");
  person_->type(later.string());
  person_->keys("Return");
  ASSERT_TRUE(refuses());
  write_mesh(icosphere(2), later);
  person_->keys("Return");
  EXPECT_TRUE(is_open("later.obj"));

  const fs::path broken = folder_.file("work/broken.obj", "v 0 0 zero\n");
  person_->open_dialog("ctrl+o");
  person_->type(broken.string());
  person_->keys("Return");
  ASSERT_TRUE(refuses()) << "the browser is there again";
  keep_picture("file-browser-error");
  write_mesh(icosphere(2), broken);
  person_->keys("Return");
  EXPECT_TRUE(is_open("broken.obj"));
  expect_quits_silently();
}

TEST_F(ChoosingFiles, WhatCannotBeSavedIsAskedForAgain) {
  open_tube();
  const fs::path target = folder_ / "nowhere" / "copy.ply";
  person_->open_dialog("ctrl+shift+s");
  person_->type(target.string());
  person_->keys("Return");
  ASSERT_TRUE(refuses());
  fs::create_directory(target.parent_path());
  person_->keys("Return");
  EXPECT_TRUE(eventually(kPatienceSeconds, [&] { return fs::exists(target); }));
  desktop_->settled_picture();
  expect_quits_silently();
}

TEST_F(ChoosingFiles, ASourceThatCannotBeReadIsAskedForAgain) {
  const fs::path source = folder_.file("work/source.obj", "f 1 2 3\n");
  open_tube();
  person_->open_dialog("ctrl+k");
  person_->open_dialog("ctrl+shift+k");
  person_->type("source.obj");
  person_->keys("Return");
  ASSERT_TRUE(refuses()) << "the browser is there again";
  const Image refused = desktop_->settled_picture();
  write_mesh(icosphere(2), source);
  person_->keys("Return");
  EXPECT_TRUE(differs_from(refused, 1.0));
  keep_picture("source-after-all");
  expect_quits_silently();
}

TEST_F(ChoosingFiles, AFileDroppedOnTheWindowAnswersTheQuestion) {
  open_tube();
  person_->open_dialog("ctrl+o");
  std::string window = desktop_->xdotool("search --onlyvisible --name Lapwing");
  window = window.substr(0, window.find('\n'));
  EXPECT_TRUE(test::drop_file(desktop_->name(), window, ball()));
  EXPECT_TRUE(is_open("ball.obj"));
  desktop_->settled_picture();
  expect_quits_silently();
}

TEST_F(ChoosingFiles, WhatCannotBeOpenedAtTheStartIsSaidThere) {
  person_->open(folder_.file("work/broken.obj", "v 0 0 zero\n"));
  ASSERT_TRUE(person_->waits_for_window()) << person_->errors();
  EXPECT_TRUE(refuses());
  keep_picture("start-with-an-error");
  expect_quits_silently();
}

TEST_F(ChoosingFiles, WhatWasOpenedIsRemembered) {
  open_tube();
  expect_quits_silently();
  EXPECT_EQ(content_of(folder_ / "state" / "lapwing" / "recent-files"),
            (work() / "tube.obj").string() + "\n");
  person_->start();
  ASSERT_TRUE(person_->waits_for_window()) << person_->errors();
  keep_picture("start-with-recent");
  expect_quits_silently();
}

TEST_F(ChoosingFiles, TheDialogOfTheDesktopIsUsedWhereThereIsOne) {
  fs::rename(ball(), work() / "models" / "größe 1.obj");
  put_zenity("echo \"$@\" > " + (folder_ / "asked").string() + "\necho '" +
             (work() / "models" / "größe 1.obj").string() + "'");
  open_tube();
  person_->keys("ctrl+o");
  EXPECT_TRUE(is_open("gr"));
  EXPECT_THAT(content_of(folder_ / "asked"), HasSubstr("--filename=" + work().string() + "/"));

  const fs::path saved = folder_ / "a b.ply";
  put_zenity("echo '" + (folder_ / "a b").string() + "'");
  person_->keys("ctrl+shift+s");
  EXPECT_FALSE(eventually(1.0, [&] { return fs::exists(saved); }))
      << "a name without extension gets that of the suggestion, which is obj here";
  EXPECT_TRUE(eventually(kPatienceSeconds, [&] { return fs::exists(folder_ / "a b.obj"); }));
  desktop_->settled_picture();
  expect_quits_silently();
}

TEST_F(ChoosingFiles, ADialogThatIsCancelledChangesNothing) {
  put_zenity("echo > " + (folder_ / "asked").string() + "\nexit 1");
  open_tube();
  person_->move_to({20, 400});
  const Image before = desktop_->settled_picture();
  person_->keys("ctrl+o");
  ASSERT_TRUE(eventually(kPatienceSeconds, [&] { return fs::exists(folder_ / "asked"); }));
  EXPECT_TRUE(shows(before, kSameScreen));
  expect_quits_silently();
}

TEST_F(ChoosingFiles, ADialogThatFailsGivesWayToTheBuiltInBrowser) {
  put_zenity("echo 'cannot open display' >&2\nexit 1");
  open_tube();
  const Image before = desktop_->settled_picture();
  person_->keys("ctrl+o");
  ASSERT_TRUE(differs_from(before, 1.0));
  desktop_->settled_picture();
  person_->type("models/ball.obj");
  person_->keys("Return");
  EXPECT_TRUE(is_open("ball.obj"));
  expect_quits_silently();
}

TEST_F(ChoosingFiles, ADialogThatNeverAnswersHoldsNoFrameUpAndEndsWithEscape) {
  put_zenity("echo $$ > " + (folder_ / "asked").string() + "\nexec /bin/sleep 600");
  open_tube();
  person_->move_to({20, 400});
  const Image before = desktop_->settled_picture();
  person_->open_dialog("ctrl+o");
  keep_picture("waiting-for-the-desktop");
  const std::string process = content_of(folder_ / "asked");
  person_->keys("Escape");
  EXPECT_TRUE(shows(before, kSameScreen));
  EXPECT_TRUE(eventually(kPatienceSeconds, [&] {
    return !fs::exists("/proc/" + process.substr(0, process.find('\n')));
  }));
  expect_quits_silently();
}

}  // namespace
}  // namespace lapwing
