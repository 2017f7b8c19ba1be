#pragma once

#include <atomic>
#include <semaphore>

#include <gtest/gtest.h>

#include "editing/editor.h"
#include "io/temporary_folder.h"
#include "lapwing/gpu/context.h"
#include "support/gpu.h"
#include "viewer_state/test_view.h"
#include "viewer_state/tube_edit.h"

namespace lapwing::viewer::test {

using lapwing::test::largest_distance;
using Phase = PreparationStatus::Phase;

// Beyond what rounding to float32 does.
inline constexpr double kVisible = 1e-5;
// Of the mesh's diagonal: what "nothing moves" means, and what settling to its tolerance leaves
// open.
inline constexpr double kNothing = 1e-6;
inline constexpr double kSettled = 1e-3;
inline const Vector2d kRight(150.0, 0.0);
inline const Vector2d kLeft(-150.0, 0.0);

// The head of a tube is in hand, seen from the front of it: x goes to the right.
class AnEditor : public ::testing::Test {
 protected:
  void SetUp() override {
    LAPWING_NEEDS_GPU();
    const AppState state = start();
    view_.camera = fit(state.rest->positions, {-Vector3d::UnitY(), Vector3d::UnitZ()},
                       kWindow.x() / kWindow.y());
    view_.size = kWindow;
    context_ = std::make_shared<gpu::Context>();
    editor_.emplace(
        EditStart{History(state), state.rest, {}, {}, folder_.path()}, context_,
        [this](const Message& said) {
          if (said == Message("", Tone::error)) return;  // nothing fails any more
          if (!expects_notes_) {
            EXPECT_EQ(said.text, "");
          }
          said_ = said.text;
        },
        [this] {
          if (!by_steps_) return;
          waits_ = true;
          steps_.acquire();
        });
    wait_until_ready();
  }
  void TearDown() override { let_worker_go(); }
  virtual AppState start() { return chosen_tube(); }

  void send(const InputEvent& event) { editor_->input().handle(event, view_); }
  void drag_mouse(const Vector2d& from, const Vector2d& to) {
    for (const InputEvent& event : {press(from), move_to(to), release(to)}) send(event);
  }
  // By the mouse alone, from the middle of the window.
  void begin_drag(const Vector2d& by) {
    const Vector2d middle = 0.5 * kWindow;
    send(move_to(middle));
    send(key('G'));
    send(move_to(middle + by));
    EXPECT_TRUE(editor_->tool().is_dragging());
  }
  // What was ready when it looked is on the screen afterwards.
  void wait_until_ready() {
    wait_until([&] {
      const bool ready = editor_->session().preparation().status().phase == Phase::ready;
      editor_->update();
      return ready;
    });
  }
  void update_until(const std::function<bool()>& happened) {
    wait_until([&] {
      editor_->update();
      return happened();
    });
  }
  // Until the handle in hand has columns.
  void wait_for_columns() {
    update_until([&] {
      return editor_->session().preparation().drag_response().response->handles() ==
             std::vector<std::size_t>{editor_->tool().handle()};
    });
  }
  Vector2d shown_pixel(Index v) const { return *view_.projection().to_pixel(rest()[v]); }

  // Until a settled result of the drag is on the screen.
  void wait_for_live_result() {
    update_until([&] { return editor_->drag().shows_live_result(); });
  }

  // The worker prepares anew and is held where the preview is ready, and nothing more.
  void prepare_the_preview_alone() {
    by_steps_ = true;
    editor_->session().cancel_preparation();
    editor_->session().prepare();
    while (!editor_->session().preparation().preview()) {
      if (waits_.exchange(false)) steps_.release();
      std::this_thread::yield();
    }
  }
  // At the next stage that it reports, so that no result comes.
  void hold_worker() { by_steps_ = true; }
  void let_worker_go() {
    by_steps_ = false;
    steps_.release();
  }
  // The handle is turned, and the surface has settled.
  void turn_and_settle(double degrees) {
    editor_->actions().perform(MoveHandle{0, twisted(degrees)});
    wait_until_ready();
    ASSERT_NE(editor_->state().settled, nullptr);
  }
  // Until the drag is settled on the screen and the worker rests.
  void wait_until_drag_is_settled() {
    wait_for_live_result();
    for (int same = 0; same < 20;) {
      const std::uint64_t version = editor_->view().device().version();
      editor_->update();
      std::this_thread::sleep_for(std::chrono::milliseconds(2));
      const bool rests = editor_->session().preparation().status().phase == Phase::ready;
      same = rests && editor_->view().device().version() == version ? same + 1 : 0;
    }
  }
  double diagonal() const { return bounds_of(rest()).diagonal(); }

  Positions on_screen() const { return editor_->view().device().shown().positions(); }
  const Positions& rest() const { return editor_->state().rest->positions; }
  // How far to the right the head is on the screen.
  double head_moved() const {
    const Index v = editor_->state().selection.handles[0].vertices.front();
    return on_screen()[v].x() - rest()[v].x();
  }

  TemporaryFolder folder_;
  bool expects_notes_ = false;
  std::string said_;
  ViewFrame view_;
  std::atomic<bool> by_steps_ = false;
  std::atomic<bool> waits_ = false;
  std::counting_semaphore<> steps_{0};
  std::shared_ptr<gpu::Context> context_;
  std::optional<Editor> editor_;
};

}  // namespace lapwing::viewer::test
