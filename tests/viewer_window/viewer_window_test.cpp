#include <fstream>
#include <memory>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "io/temporary_folder.h"
#include "lapwing/io/mesh_file.h"
#include "lapwing/mesh/shapes.h"
#include "support/faulty_driver.h"
#include "support/gpu.h"
#include "viewer_panels/bent_tube.h"
#include "viewer_window/desktop.h"

namespace lapwing {
namespace {

namespace fs = std::filesystem;
using test::Desktop;
using test::eventually;
using test::Process;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

// Frames of a software device on a busy machine.
constexpr double kWindowPatience = 60.0;

class ViewerWindow : public ::testing::Test {
 protected:
  void SetUp() override {
    LAPWING_NEEDS_DESKTOP();
    write_mesh(rippled_cylinder(24, 41), tube());
    desktop_ = std::make_unique<Desktop>(folder_.path());
  }

  fs::path tube() const { return folder_ / "tube.obj"; }

  // The messages of the validation layers, where they are on, go to standard error. (Not under
  // AddressSanitizer: they leak what they know of swapchains.)
  void start(std::vector<std::string> arguments, const std::vector<std::string>& more = {}) {
    arguments.insert(arguments.begin(), LAPWING_VIEWER);
    std::vector<std::string> environment = test::viewer_environment(*desktop_, folder_.path());
    environment.insert(environment.end(), more.begin(), more.end());
    viewer_ = std::make_unique<Process>(arguments, environment, folder_ / "errors");
  }

  // On a driver that fails (test::FaultyDriver).
  void start_with_fault(const std::string& fault, std::vector<std::string> arguments) {
    start(std::move(arguments),
          {std::string("LAPWING_VULKAN_LOADER=") + test::FaultyDriver::loader(),
           "LAPWING_DRIVER_FAULT=" + fault});
  }

  // Opens the tube and waits until it is on the screen.
  Image open_tube() {
    start({tube()});
    EXPECT_TRUE(eventually(kWindowPatience, [&] {
      window_ = desktop_->xdotool("search --onlyvisible --name Lapwing");
      return !window_.empty() || !viewer_->running();
    }));
    EXPECT_TRUE(viewer_->running()) << viewer_->errors();
    if (!window_.empty()) window_.pop_back();
    // The mesh hides the background in the middle of what the panels leave free.
    EXPECT_TRUE(eventually(kWindowPatience, [&] { return shows_the_tube(desktop_->picture()); }));
    return desktop_->settled_picture();
  }

  bool differs_from(const Image& picture) const {
    return eventually(kWindowPatience,
                      [&] { return test::mean_difference(desktop_->picture(), picture) > 1.0; });
  }

  // The background is lighter than the tube, the panels are darker.
  static bool shows_the_tube(const Image& image) {
    const auto red = image.pixel(790, 400)[0];
    return red > 60 && red < 190;
  }

  // Where notes stand: left of the picture, above the guide.
  static Image note(const Image& image) {
    constexpr std::uint32_t kLeft = 385;
    constexpr std::uint32_t kAboveGuide = 90;
    constexpr std::uint32_t kHeight = 30;
    return test::part_of(image, kLeft, image.height - kAboveGuide - kHeight, 300, kHeight);
  }

  void expect_quits_silently() {
    desktop_->xdotool("key ctrl+q");
    EXPECT_EQ(viewer_->wait(kWindowPatience), 0);
    EXPECT_THAT(viewer_->errors(), IsEmpty());
  }
  void expect_fails(int code, const std::string& words) {
    EXPECT_EQ(viewer_->wait(kWindowPatience), code);
    EXPECT_THAT(viewer_->errors(), HasSubstr(words));
  }

  TemporaryFolder folder_;
  std::unique_ptr<Desktop> desktop_;
  std::unique_ptr<Process> viewer_;
  std::string window_;
};

TEST_F(ViewerWindow, MouseAndKeysMoveTheView) {
  const Image first = open_tube();
  desktop_->xdotool("mousemove 790 300 mousedown 2 mousemove 700 340 mousemove 600 380 mouseup 2");
  EXPECT_TRUE(differs_from(first)) << "a drag of the middle button orbits";
  const Image orbited = desktop_->settled_picture();

  desktop_->xdotool("mousemove 790 400 click 4 click 4");
  EXPECT_TRUE(differs_from(orbited)) << "the wheel zooms";
  const Image zoomed = desktop_->settled_picture();

  desktop_->xdotool("key 0 key Home");
  EXPECT_TRUE(eventually(kWindowPatience, [&] {
    return test::mean_difference(desktop_->picture(), first) < 0.5;
  })) << "the first view is back";
  expect_quits_silently();
}

TEST_F(ViewerWindow, AClickSaysWhatIsThere) {
  open_tube();
  desktop_->xdotool("key m");
  const Image first = note(desktop_->settled_picture());
  const auto says = [&](const std::string& click) {
    desktop_->xdotool(click);
    desktop_->settled_picture();
    return test::mean_difference(note(desktop_->picture()), first);
  };
  const double of_the_tube = says("mousemove 790 400 click 1");
  const double of_the_background = says("mousemove 400 100 click 1");
  EXPECT_GT(of_the_tube, 1.0);
  EXPECT_LT(of_the_background, of_the_tube);
  expect_quits_silently();
}

// A window manager minimizes by unmapping.
TEST_F(ViewerWindow, ComesBackAfterItWasMinimized) {
  open_tube();
  for (const char* size : {"1280 800", "300 200", "1280 800"}) {
    desktop_->xdotool("windowunmap --sync " + window_);
    desktop_->xdotool("windowsize " + window_ + " " + size);
    desktop_->xdotool("windowmap --sync " + window_);
    ASSERT_TRUE(viewer_->running()) << viewer_->errors();
  }
  EXPECT_TRUE(eventually(kWindowPatience, [&] { return shows_the_tube(desktop_->picture()); }));
  expect_quits_silently();
}

TEST_F(ViewerWindow, SurvivesAResizeStorm) {
  open_tube();
  std::string storm;
  constexpr int kSizes = 200;
  for (int i = 0; i < kSizes; ++i) {
    const int width = 80 + i * 397 % 1200;
    const int height = 70 + i * 211 % 730;
    storm += " windowsize " + window_ + " " + std::to_string(width) + " " + std::to_string(height) +
             " sleep 0.02";
  }
  desktop_->xdotool(storm);
  ASSERT_TRUE(viewer_->running()) << viewer_->errors();
  desktop_->xdotool("windowsize " + window_ + " 1280 800 windowmove " + window_ + " 0 0");
  desktop_->xdotool("key Home");
  EXPECT_TRUE(eventually(kWindowPatience, [&] { return shows_the_tube(desktop_->picture()); }));
  expect_quits_silently();
}

TEST_F(ViewerWindow, ShowsWhatARecipeMakesInTheColoursOfItsRegions) {
  start({viewer::test::write_bent_tube(folder_.path(), 2)});
  const auto shows = [&](auto is_color) {
    const Image image = desktop_->picture();
    for (std::uint32_t y = 40; y < 770; y += 5) {
      for (std::uint32_t x = 320; x < 1270; x += 5) {
        if (is_color(image.pixel(x, y))) return true;
      }
    }
    return false;
  };
  const auto yellow = [](const auto& p) { return p[0] > 150 && p[1] > 110 && p[2] < 80; };
  const auto red = [](const auto& p) { return p[0] > 120 && p[1] < 70 && p[2] < 70; };
  EXPECT_TRUE(eventually(kWindowPatience, [&] { return shows(yellow) && shows(red); }));
  expect_quits_silently();
}

TEST_F(ViewerWindow, SavesAPictureOfAnySizeAndQuits) {
  const fs::path picture = folder_ / "tube.png";
  start({tube(), "--screenshot", picture, "--size", "333x222"});
  EXPECT_EQ(viewer_->wait(kWindowPatience), 0);
  EXPECT_THAT(viewer_->errors(), IsEmpty());
  std::ifstream file(picture, std::ios::binary);
  std::string bytes(24, '\0');
  file.read(bytes.data(), 24);
  EXPECT_EQ(bytes.substr(12), std::string("IHDR\0\0\1\x4d\0\0\0\xde", 12));
}

TEST_F(ViewerWindow, SaysWhatIsWrongWithAFile) {
  std::ofstream(tube()) << "v 1 2\n";
  start({tube(), "--screenshot", folder_ / "tube.png"});
  expect_fails(3, "tube.obj:1");
}

TEST_F(ViewerWindow, WithoutDisplaySaysSo) {
  start({}, {"DISPLAY="});
  expect_fails(5, "DISPLAY");
}

TEST_F(ViewerWindow, SaysThatTheDisplayWentAway) {
  open_tube();
  desktop_->vanish();
  expect_fails(5, "lost the connection to the display");
}

TEST_F(ViewerWindow, SaysThatTheDisplayWentAwayInTheMiddleOfADrag) {
  open_tube();
  desktop_->xdotool("mousemove 790 300 mousedown 2 mousemove 700 340 mousemove 600 380");
  desktop_->vanish();
  expect_fails(5, "lost the connection to the display");
}

// Opening the window, showing the mesh and drawing the picture each take memory of the device.
TEST_F(ViewerWindow, AnOrderedPictureIsDrawnOrRefusedWhereverMemoryFails) {
  const fs::path picture = folder_ / "picture.png";
  int drawn = 0;
  for (int number = 60; number <= 180; number += 20) {
    fs::remove(picture);
    start_with_fault("memory " + std::to_string(number),
                     {tube(), "--screenshot", picture, "--size", "64x48"});
    const int code = viewer_->wait(kWindowPatience);
    EXPECT_EQ(code, fs::exists(picture) ? 0 : 5) << number << ": " << viewer_->errors();
    if (code == 0) ++drawn;
  }
  EXPECT_GT(drawn, 3);
}

TEST_F(ViewerWindow, WithoutADeviceThatDrawsSaysThatTheEditIsKept) {
  start_with_fault("loss 20 ever after", {tube()});
  expect_fails(5, "VK_ERROR_DEVICE_LOST");
  EXPECT_THAT(viewer_->errors(), HasSubstr("your edit is kept"));
}

TEST_F(ViewerWindow, WithoutVulkanSaysSo) {
  start({}, {"LAPWING_VULKAN_LOADER=/nowhere.so"});
  expect_fails(5, "no Vulkan loader");
}

}  // namespace
}  // namespace lapwing
