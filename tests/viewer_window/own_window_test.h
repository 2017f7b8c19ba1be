#pragma once

#include <cstdlib>
#include <memory>

#include <gtest/gtest.h>

#include "io/temporary_folder.h"
#include "support/gpu.h"
#include "viewer_window/desktop.h"
#include "window/window.h"

namespace lapwing::viewer::test {

/// A test with a desktop on which the test program itself opens a window.
class OwnWindowTest : public ::testing::Test {
 protected:
  void SetUp() override {
    LAPWING_NEEDS_DESKTOP();
    desktop_ = std::make_unique<lapwing::test::Desktop>(folder_.path());
    setenv("DISPLAY", desktop_->name().c_str(), 1);
    unsetenv("WAYLAND_DISPLAY");
    window_ = std::make_unique<Window>("Lapwing", 640, 400);
  }

  TemporaryFolder folder_;
  std::unique_ptr<lapwing::test::Desktop> desktop_;
  std::unique_ptr<Window> window_;
};

}  // namespace lapwing::viewer::test
