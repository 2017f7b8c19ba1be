// What a person goes on to do while the last edit still settles comes to what it does once it has.
#include <functional>

#include <gtest/gtest.h>

#include "viewer_editing/an_editor.h"

namespace lapwing::viewer::test {
namespace {

class WhileItSettles : public AnEditor {
 protected:
  void SetUp() override {
    AnEditor::SetUp();
    if (!editor_) return;
    expects_notes_ = true;
    editor_->actions().perform(Choose{kRoi, box(2.3, 4.0)});
    wait_until_ready();
  }

  using Gesture = std::function<void()>;

  // Frames go on between the events of a person.
  void send_in_frames(const std::vector<InputEvent>& events) {
    for (const InputEvent& event : events) {
      send(event);
      editor_->update();
    }
  }

  // Until nothing is left to do; of a new edit nothing may be prepared yet.
  void finish() {
    const auto phase = [&] { return editor_->session().preparation().status().phase; };
    update_until([&] {
      return !editor_->actions().waits() && (phase() == Phase::ready || phase() == Phase::idle);
    });
  }

  // The head is turned, and then this is done.
  void turn_and_go_on(const Gesture& go_on) {
    editor_->tool().choose(kHandle);
    editor_->tool().take(Action::take_disk);
    editor_->actions().perform(MoveHandle{0, twisted(30.0)});
    go_on();
    finish();
  }

  void expect_the_same_as_later(const Gesture& go_on) {
    turn_and_go_on([&] {
      finish();
      go_on();
    });
    const AppState wanted = editor_->state();
    const Part part = editor_->tool().part();
    const std::size_t done = editor_->session().history().done();
    editor_->actions().go_to(1);
    finish();
    hold_worker();
    turn_and_go_on([&] {
      go_on();
      ASSERT_TRUE(editor_->actions().waits());
      EXPECT_EQ(editor_->session().history().done(), 2U) << "nothing before it has settled";
      EXPECT_NE(said_.find("when the last edit is refined"), std::string::npos) << said_;
      let_worker_go();
    });
    EXPECT_TRUE(same(editor_->state(), wanted));
    EXPECT_EQ(editor_->tool().part(), part);
    EXPECT_EQ(editor_->session().history().done(), done);
    EXPECT_EQ(editor_->state().steps.size(), wanted.steps.size());
  }

  const Vector2d elsewhere_ = 0.5 * kWindow + Vector2d(0.0, 80.0);
};

TEST_F(WhileItSettles, ADiskElsewhereBeginsANewEdit) {
  expect_the_same_as_later([&] {
    const Vector2d rim = elsewhere_ + Vector2d(0.0, 80.0);
    send_in_frames({press(elsewhere_), move_to(rim), release(rim)});
  });
  EXPECT_EQ(editor_->state().steps.size(), 1U);
  EXPECT_TRUE(editor_->state().selection.handles.empty());
  EXPECT_NE(said_.find("New edit"), std::string::npos) << said_;
}

TEST_F(WhileItSettles, AndItsHandleIsChosenInIt) {
  expect_the_same_as_later([&] {
    const Vector2d rim = elsewhere_ + Vector2d(0.0, 80.0);
    const Vector2d inner = elsewhere_ + Vector2d(0.0, 25.0);
    send_in_frames({press(elsewhere_), move_to(rim), release(rim)});
    send_in_frames({press(elsewhere_), move_to(inner), release(inner)});
  });
  EXPECT_EQ(editor_->state().selection.handles.size(), 1U);
  EXPECT_TRUE(editor_->tool().has_gizmo());
}

// A first radius goes by the size of what is seen, which is not settled yet.
TEST_F(WhileItSettles, ADiskThatIsClickedIsSized) {
  hold_worker();
  turn_and_go_on([&] {
    send_in_frames({press(elsewhere_), release(elsewhere_)});
    for (int notch = 0; notch < 3; ++notch) send_in_frames({scrolled(elsewhere_, 1.0, kSizes)});
    send_in_frames({key(']')});
    let_worker_go();
  });
  const auto* disk = std::get_if<GeodesicDisk>(&editor_->state().selection.roi.made.form);
  ASSERT_NE(disk, nullptr);
  EXPECT_NEAR(disk->radius, 0.1 * std::pow(1.1, 4) * diagonal(), 0.02 * diagonal());
  EXPECT_EQ(editor_->session().history().done(), 3U) << "ROI, drag, and the disk as one step";
}

TEST_F(WhileItSettles, AStrokeElsewhereBeginsANewEdit) {
  expect_the_same_as_later([&] {
    editor_->tool().take(Action::take_box);
    editor_->tool().choose(kRoi);
    const Vector2d corner = 0.5 * kWindow + Vector2d(-60.0, 60.0);
    const Vector2d opposite = corner + Vector2d(120.0, 60.0);
    send_in_frames({press(corner), move_to(opposite), release(opposite)});
  });
}

TEST_F(WhileItSettles, ALoopElsewhereBeginsANewEdit) {
  expect_the_same_as_later([&] {
    editor_->tool().choose(kRoi);
    editor_->tool().take(Action::take_loop);
    const auto pixel = [&](double x, double z) {
      return *view_.projection().to_pixel({x, -0.3, z});
    };
    for (const Vector2d& corner :
         {pixel(-0.4, 0.6), pixel(0.4, 0.6), pixel(0.4, 1.5), pixel(-0.4, 1.5)}) {
      send_in_frames({press(corner), release(corner)});
    }
    send_in_frames({key(kEnter), press(pixel(0.0, 1.0)), release(pixel(0.0, 1.0))});
  });
  EXPECT_TRUE(editor_->state().selection.handles.empty());
}

// At a vertex that is seen whole, though not yet where it settles.
TEST_F(WhileItSettles, APinIsSetAndDraggedInOneGesture) {
  std::optional<Vector2d> pin;
  expect_the_same_as_later([&] {
    editor_->tool().take(Action::take_pin);
    if (!pin) {
      const Positions settled = on_screen();
      Index front = 0;
      for (Index v = 0; v < settled.size(); ++v) {
        if (std::abs(settled[v].z() - 2.6) < 0.1 && settled[v].y() < settled[front].y()) front = v;
      }
      pin = view_.projection().to_pixel(settled[front]);
    }
    const Vector2d there = *pin + 0.3 * kRight;
    send_in_frames({press(*pin), move_to(there), release(there)});
  });
  ASSERT_EQ(editor_->state().selection.handles.size(), 2U);
  EXPECT_FALSE(editor_->state().moves[1].is_at_rest());
}

TEST_F(WhileItSettles, UndoGivesUpWhatWaitsAndThenTheDrag) {
  hold_worker();
  editor_->tool().choose(kHandle);
  editor_->tool().take(Action::take_disk);
  editor_->actions().perform(MoveHandle{0, twisted(30.0)});
  const Vector2d rim = elsewhere_ + Vector2d(0.0, 80.0);
  send_in_frames({press(elsewhere_), move_to(rim), release(rim)});
  ASSERT_TRUE(editor_->actions().has_postponed());
  editor_->actions().undo();
  EXPECT_FALSE(editor_->actions().has_postponed());
  EXPECT_TRUE(is_moved(editor_->state()));
  EXPECT_EQ(editor_->session().history().done(), 2U);
  editor_->actions().undo();
  EXPECT_FALSE(is_moved(editor_->state()));
  let_worker_go();
  finish();
  EXPECT_EQ(editor_->session().history().done(), 1U);
}

// The result comes between the press and the release.
TEST_F(WhileItSettles, AStrokeUnderWayGoesOnOverTheResult) {
  editor_->tool().choose(kHandle);
  editor_->tool().take(Action::take_disk);
  hold_worker();
  editor_->actions().perform(MoveHandle{0, twisted(30.0)});
  const Vector2d rim = elsewhere_ + Vector2d(0.0, 80.0);
  send_in_frames({press(elsewhere_), move_to(0.5 * (elsewhere_ + rim))});
  let_worker_go();
  update_until([&] { return !needs_settling(editor_->state()); });
  send_in_frames({move_to(rim), release(rim)});
  EXPECT_EQ(editor_->state().steps.size(), 1U);
  EXPECT_TRUE(editor_->state().selection.handles.empty());
  EXPECT_FALSE(editor_->state().selection.roi.vertices.empty());
}

}  // namespace
}  // namespace lapwing::viewer::test
