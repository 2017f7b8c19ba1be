#include "editing/editor.h"

#include <chrono>
#include <thread>

#include <gtest/gtest.h>

#include "io/temporary_folder.h"
#include "lapwing/gpu/context.h"
#include "support/gpu.h"
#include "viewer_state/test_view.h"
#include "viewer_state/tube_edit.h"

namespace lapwing::viewer::test {
namespace {

using lapwing::test::largest_distance;
using Phase = PreparationStatus::Phase;

// Beyond what rounding to float32 does.
constexpr double kVisible = 1e-5;
const Vector2d kRight(150.0, 0.0);
const Vector2d kLeft(-150.0, 0.0);

// The head of a tube is in hand, seen from the front of it: x goes to the right.
class AnEditor : public ::testing::Test {
 protected:
  void SetUp() override {
    LAPWING_NEEDS_GPU();
    const AppState state = chosen_tube();
    view_.camera = fit(state.rest->positions, {-Vector3d::UnitY(), Vector3d::UnitZ()},
                       kWindow.x() / kWindow.y());
    view_.size = kWindow;
    kernels_.emplace(std::make_shared<gpu::Context>(), Precision::automatic);
    editor_.emplace(
        EditStart{History(state), {state.rest, state.topology}, {}, {}, folder_.path()}, *kernels_,
        [](const std::string& said) { EXPECT_EQ(said, ""); }, std::function<void()>());
    wait_until_ready();
  }

  void send(const InputEvent& event) { editor_->handle(event, view_); }
  // By the mouse alone, from the middle of the window.
  void begin_drag(const Vector2d& by) {
    const Vector2d middle = 0.5 * kWindow;
    send(move_to(middle));
    send(key('G'));
    send(move_to(middle + by));
    EXPECT_TRUE(editor_->is_dragging());
  }
  // What was ready when it looked is on the screen afterwards.
  void wait_until_ready() {
    for (bool ready = false; !ready;) {
      ready = editor_->session().preparation().status().phase == Phase::ready;
      editor_->update();
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
  }
  // Until a settled result of the drag is on the screen.
  void wait_for_live_result() {
    do {
      editor_->update();
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    } while (!editor_->shown().follows() || editor_->surface().source() != SurfaceSource::still);
  }

  Positions on_screen() const { return editor_->surface().shown().positions(); }
  const Positions& rest() const { return editor_->state().rest->positions; }
  // How far to the right the head is on the screen.
  double head_moved() const {
    const Index v = editor_->state().selection.handles[0].vertices.front();
    return on_screen()[v].x() - rest()[v].x();
  }

  TemporaryFolder folder_;
  ViewFrame view_;
  std::optional<VulkanKernels> kernels_;
  std::optional<Editor> editor_;
};

TEST_F(AnEditor, DragThatIsGivenUpLeavesNothing) {
  for (const InputEvent& end :
       {key(kEscape), at(InputKind::press, 0.5 * kWindow, MouseButton::right)}) {
    begin_drag(kRight);
    editor_->update();
    EXPECT_GT(head_moved(), 0.2);
    send(end);
    editor_->update();
    EXPECT_FALSE(editor_->is_dragging());
    EXPECT_LT(largest_distance(on_screen(), rest()), kVisible);
    EXPECT_FALSE(is_moved(editor_->state()));
    EXPECT_EQ(editor_->session().history().done(), 0U);
  }
}

TEST_F(AnEditor, WhatSettledOfADragThatIsGivenUpNeverShows) {
  editor_->set_settles_while_dragging(true);
  begin_drag(kRight);
  wait_for_live_result();
  EXPECT_GT(head_moved(), 0.2);
  send(move_to(0.5 * kWindow + 1.1 * kRight));
  editor_->update();
  send(key(kEscape));
  editor_->update();
  EXPECT_LT(largest_distance(on_screen(), rest()), kVisible);
  wait_until_ready();
  EXPECT_LT(largest_distance(on_screen(), rest()), kVisible);
  EXPECT_EQ(editor_->session().take_live_result(), nullptr);
  begin_drag(kLeft);
  editor_->update();
  EXPECT_LT(head_moved(), -0.2) << "of this drag";
}

TEST_F(AnEditor, DragThatIsGivenUpLeavesTheResultBefore) {
  begin_drag(kRight);
  send(key(kEnter));
  wait_until_ready();
  const Positions before = on_screen();
  const auto settled = editor_->state().settled;
  ASSERT_NE(settled, nullptr);
  begin_drag(kLeft);
  editor_->update();
  EXPECT_GT(largest_distance(on_screen(), before), 0.2);
  send(key(kEscape));
  editor_->update();
  EXPECT_EQ(on_screen(), before);
  EXPECT_EQ(editor_->state().settled, settled);
}

TEST_F(AnEditor, ResultOnItsWayComesThoughAnotherDragWasGivenUp) {
  begin_drag(kRight);
  send(key(kEnter));
  EXPECT_TRUE(needs_settling(editor_->state()));
  begin_drag(kLeft);
  editor_->update();
  send(key(kEscape));
  wait_until_ready();
  EXPECT_FALSE(needs_settling(editor_->state()));
  EXPECT_GT(head_moved(), 0.2);
}

}  // namespace
}  // namespace lapwing::viewer::test
