#include "window/main_loop.h"

#include <functional>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "lapwing/gpu/context.h"
#include "lapwing/gpu/devices.h"
#include "lapwing/io/mesh_file.h"
#include "support/environment.h"
#include "support/failing_new.h"
#include "support/faulty_driver.h"
#include "support/gpu.h"
#include "ui/viewer_app.h"
#include "viewer_panels/bent_tube.h"
#include "viewer_window/faulty_driver.h"
#include "viewer_window/own_window_test.h"
#include "viewer_window/test_frames.h"

namespace lapwing::viewer {
namespace {

namespace fs = std::filesystem;
using lapwing::test::Desktop;
using lapwing::test::DriverFault;
using lapwing::test::mean_difference;
using test::DraggedSphere;
using test::Fault;
using Call = Fault::Call;
using test::FaultyGraphics;

constexpr int kFaultyFrame = 4;
constexpr int kLastFrame = 12;

using MainLoopTest = test::OwnWindowTest;

// Drags a sphere a little in every frame and quits after some.
class SphereApp final : public App {
 public:
  explicit SphereApp(std::shared_ptr<gpu::Context> context) : context_(std::move(context)) {
    sphere_ = std::make_unique<DraggedSphere>(context_);
  }

  bool handle(const InputEvent&) override { return false; }
  void open(const fs::path&) override {}
  void resize(const Eigen::Vector2d&, double) override {}
  void draw_ui(const FrameTimings&) override {
    ++frames;
    if (on_frame) on_frame(frames);
    sphere_->drag(0.01 * frames);
    Window::wake();
  }
  Scene scene() override { return sphere_->scene(); }
  std::string_view title() const override { return "a title longer than a short string"; }
  void ask_to_close() override {}
  bool wants_to_quit() const override { return frames >= kLastFrame; }
  void use_device(std::shared_ptr<gpu::Context> context) override {
    EXPECT_NE(context, context_);
    sphere_.reset();
    context_ = std::move(context);
    sphere_ = std::make_unique<DraggedSphere>(context_);
    ++devices_taken;
  }

  int frames = 0;
  int devices_taken = 0;
  std::function<void(int)> on_frame;

 private:
  std::shared_ptr<gpu::Context> context_;
  std::unique_ptr<DraggedSphere> sphere_;
};

// What was opened until the app quit.
struct Outcome {
  int devices = 0;
  int screens = 0;
  int devices_taken = 0;

  bool operator==(const Outcome&) const = default;
};
constexpr Outcome kNothingOpenedAgain{1, 1, 0};
constexpr Outcome kScreenOpenedAgain{1, 2, 0};
constexpr Outcome kDeviceOpenedAgain{2, 2, 1};

Outcome run_with(Window& window, const Fault& fault) {
  FaultyGraphics graphics(window, fault);
  const auto context = graphics.open_device();
  SphereApp app(context);
  run_main_loop(window, graphics, context, app);
  EXPECT_EQ(app.frames, kLastFrame);
  return {graphics.devices, graphics.screens, app.devices_taken};
}

TEST_F(MainLoopTest, WithoutFaultsOpensEverythingOnce) {
  EXPECT_EQ(run_with(*window_, {}), kNothingOpenedAgain);
}

TEST_F(MainLoopTest, GoesOnWhereImagesNoLongerFitOrComeLate) {
  for (const VkResult result : {VK_ERROR_OUT_OF_DATE_KHR, VK_SUBOPTIMAL_KHR, VK_TIMEOUT}) {
    EXPECT_EQ(run_with(*window_, {Call::acquire, result, kFaultyFrame}), kNothingOpenedAgain);
  }
  for (const VkResult result : {VK_ERROR_OUT_OF_DATE_KHR, VK_SUBOPTIMAL_KHR}) {
    EXPECT_EQ(run_with(*window_, {Call::present, result, kFaultyFrame}), kNothingOpenedAgain);
  }
}

TEST_F(MainLoopTest, OpensALostSurfaceAgain) {
  for (const Call call : {Call::acquire, Call::present}) {
    EXPECT_EQ(run_with(*window_, {call, VK_ERROR_SURFACE_LOST_KHR, kFaultyFrame}),
              kScreenOpenedAgain);
  }
}

TEST_F(MainLoopTest, OpensALostDeviceAgainAndTellsTheApp) {
  for (const Call call : {Call::acquire, Call::present}) {
    EXPECT_EQ(run_with(*window_, {call, VK_ERROR_DEVICE_LOST, kFaultyFrame}), kDeviceOpenedAgain);
  }
  // A frame is one submission, which contains the drag and the drawing.
  for (const int number : {8, 9}) {
    EXPECT_EQ(run_with(*window_, {Call::submit, VK_ERROR_DEVICE_LOST, number}), kDeviceOpenedAgain);
  }
}

// The device is lost at any submission or wait of a frame, or has no memory for any of its
// commands.
TEST_F(MainLoopTest, GoesOnWhereverAFrameFails) {
  const lapwing::test::FaultyDriver driver;
  for (const DriverFault fault : {DriverFault::loss, DriverFault::memory}) {
    int number = 0;
    for (bool has_failed = true; has_failed; ++number) {
      WindowGraphics graphics(*window_, "auto");
      auto context = graphics.open_device();
      SphereApp app(context);
      app.on_frame = [&](int frame) {
        if (frame == kFaultyFrame) driver.fail(fault, number);
        if (frame != kFaultyFrame + 1) return;
        has_failed = driver.has_failed();
        driver.work();
      };
      run_main_loop(*window_, graphics, std::move(context), app);
      EXPECT_EQ(app.frames, kLastFrame);
      EXPECT_EQ(app.devices_taken, has_failed ? 1 : 0) << name_of(fault) << " " << number;
    }
    EXPECT_GT(number, 2) << name_of(fault);
  }
}

TEST_F(MainLoopTest, OpensADeviceThatDoesNotOpenAtOnce) {
  const lapwing::test::FaultyDriver driver;
  WindowGraphics graphics(*window_, "auto");
  auto context = graphics.open_device();
  SphereApp app(context);
  app.on_frame = [&](int frame) {
    if (frame != kFaultyFrame) return;
    driver.fail(DriverFault::memory, 0);
    throw gpu::DeviceLost("the test's device is gone");
  };
  run_main_loop(*window_, graphics, std::move(context), app);
  EXPECT_TRUE(driver.has_failed());
  EXPECT_EQ(app.devices_taken, 1);
}

TEST_F(MainLoopTest, EndsWhereEveryFrameLosesTheSurface) {
  EXPECT_THROW(run_with(*window_, {Call::acquire, VK_ERROR_SURFACE_LOST_KHR, 0, true}),
               SurfaceLost);
}

TEST_F(MainLoopTest, EndsWhereEveryFrameLosesTheDevice) {
  EXPECT_THROW(run_with(*window_, {Call::present, VK_ERROR_DEVICE_LOST, 0, true}), gpu::DeviceLost);
}

// Forwards the calls of the main loop to the viewer's app.
class InnerViewer : public App {
 public:
  InnerViewer(std::shared_ptr<gpu::Context> context, const fs::path& folder)
      : viewer_(std::move(context), {.journals = folder / "journals"}) {}

  bool handle(const InputEvent& event) override { return viewer_.handle(event); }
  void open(const fs::path& file) override { viewer_.open(file); }
  void resize(const Eigen::Vector2d& size, double scale) override { viewer_.resize(size, scale); }
  Scene scene() override { return viewer_.scene(); }
  std::string_view title() const override { return viewer_.title(); }
  void ask_to_close() override {}
  void use_device(std::shared_ptr<gpu::Context> context) override {
    viewer_.use_device(std::move(context));
  }

 protected:
  ViewerApp viewer_;
};

// Drags a handle in the viewer, with one mouse move per frame.
class DraggingViewer final : public InnerViewer {
 public:
  using InnerViewer::InnerViewer;

  bool wants_to_quit() const override { return quiet_frames_ == kQuietFrames || frames_ == kMost; }

  Scene scene() override {
    const Scene scene = viewer_.scene();
    is_open_ = scene.surface != nullptr;
    return scene;
  }

  void draw_ui(const FrameTimings& last) override {
    Window::wake();
    follows_ = last.blend_ms > 0.0;
    if (is_open_) drag();
    viewer_.draw_ui(last);
  }

  bool is_quiet() const { return quiet_frames_ == kQuietFrames; }

 private:
  static constexpr int kQuietFrames = 20;
  static constexpr int kMost = 3000;

  // The worker, which prepares the edit meanwhile, needs memory until it is done.
  void drag() {
    const long calls = lapwing::test::FailingNew::calls();
    quiet_frames_ = follows_ && calls == calls_ ? quiet_frames_ + 1 : 0;
    calls_ = calls;
    if (frames_++ == 0) viewer_.handle({.kind = InputKind::key, .key = 'G'});
    viewer_.handle({.kind = InputKind::move, .position = {400.0 + frames_ % 50, 200.0}});
  }

  bool is_open_ = false;
  bool follows_ = false;
  int frames_ = 0;
  int quiet_frames_ = 0;
  long calls_ = 0;
};

// By the linear response: what settles on the way comes with positions of its own each time.
TEST_F(MainLoopTest, DraggingAHandleInTheViewerAllocatesNothing) {
  const lapwing::test::Environment without_validation("LAPWING_VALIDATION", "");
  const fs::path recipe = test::write_bent_tube(folder_.path(), 2, R"(, "settle": false)");
  WindowGraphics graphics(*window_, "auto");
  const auto context = graphics.open_device();
  DraggingViewer app(context, folder_.path());
  app.open(recipe);
  const lapwing::test::FailingNew counting(-1);
  run_main_loop(*window_, graphics, context, app);
  EXPECT_TRUE(app.is_quiet());
}

// Loses its device when a mesh is on the screen. Stores an image from before and one from after.
class WatchedViewer final : public InnerViewer {
 public:
  WatchedViewer(std::shared_ptr<gpu::Context> context, const Desktop& desktop)
      : InnerViewer(std::move(context), desktop.folder()), desktop_(desktop) {}

  bool wants_to_quit() const override { return pictures_.size() == 2; }

  void draw_ui(const FrameTimings& last) override {
    Window::wake();
    shown_ = viewer_.scene().surface != nullptr ? shown_ + 1 : 0;
    // A view of its own, which must be kept.
    if (shown_ == 2 && devices_ == 1) viewer_.handle({.kind = InputKind::key, .key = kLeft});
    // A view that was jumped to is drawn finely once it has stood still.
    if (shown_ == kFaultyFrame - 1) lapwing::test::sleep_seconds(0.3);
    if (shown_ == kFaultyFrame) {
      // Without the panels, the tools and the messages.
      pictures_.push_back(lapwing::test::part_of(desktop_.settled_picture(), 390, 80, 230, 150));
      if (pictures_.size() == 1) throw gpu::DeviceLost("blend");
    }
    viewer_.draw_ui(last);
  }

  void use_device(std::shared_ptr<gpu::Context> context) override {
    ++devices_;
    shown_ = 0;
    InnerViewer::use_device(std::move(context));
  }

  const std::vector<Image>& pictures() const { return pictures_; }

 private:
  const Desktop& desktop_;
  std::vector<Image> pictures_;
  int shown_ = 0;
  int devices_ = 1;
};

TEST_F(MainLoopTest, TheViewerShowsTheSameOnTheNextDevice) {
  write_mesh(icosphere(2), folder_ / "sphere.obj");
  FaultyGraphics graphics(*window_, {});
  auto context = graphics.open_device();
  WatchedViewer app(context, *desktop_);
  app.open(folder_ / "sphere.obj");
  run_main_loop(*window_, graphics, std::move(context), app);
  ASSERT_EQ(app.pictures().size(), 2U);
  EXPECT_EQ(graphics.devices, 2);
  EXPECT_LT(mean_difference(app.pictures()[0], app.pictures()[1]), 0.01);
  // In the middle of the part that the sidebar does not cover.
  const auto middle = app.pictures()[1].pixel(122, 110);
  EXPECT_GE(middle[0], middle[2]) << "the sphere, not the background";
}

}  // namespace
}  // namespace lapwing::viewer
