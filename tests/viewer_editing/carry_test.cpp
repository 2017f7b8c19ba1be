// What is carried along is on the screen where the surface is.
#include <fstream>

#include <gtest/gtest.h>

#include "lapwing/io/mesh_file.h"
#include "lapwing/mesh/shapes.h"
#include "lapwing/mesh/transform.h"
#include "viewer_editing/an_editor.h"

namespace lapwing::viewer::test {
namespace {

// Of what settling to its tolerance leaves open.
constexpr double kLeftOpen = 5e-3;

// The edit carries a hat on the upper end of the tube, and points around it.
class AnEditorThatCarries : public AnEditor {
 protected:
  AppState start() override {
    Mesh hat = icosphere(2);
    transform(hat, Eigen::Translation3d(0.0, 0.0, 3.1) * Eigen::Scaling(0.3));
    write_mesh(hat, folder_ / "hat.obj");
    std::ofstream(folder_ / "points.csv") << "0.9,0,2.9\n0,0.9,2.9\n0.9,0,0.1\n";
    AppState state = chosen_tube();
    for (const char* file : {"hat.obj", "points.csv"}) {
      state = apply(std::move(state), CarryAlong{open_carried(folder_ / file)});
    }
    return state;
  }

  // The hat once neither it nor the surface moves any more, which goes part of the way at a time
  // until it has settled near the hand.
  Positions at_rest_in_the_hand() {
    constexpr int kUpdates = 10;
    Positions hats;
    Positions surface;
    int still = 0;
    update_until([&] {
      const Positions hats_before = std::exchange(hats, hat());
      const Positions before = std::exchange(surface, on_screen());
      const bool rests = editor_->session().preparation().status().phase == Phase::ready;
      still = rests && hats == hats_before && surface == before ? still + 1 : 0;
      std::this_thread::sleep_for(std::chrono::milliseconds(30));
      return still == kUpdates;
    });
    return hats;
  }
  Positions hat() const { return editor_->view().carried().drawn()[0].surface->positions(); }
  Positions at_rest() const { return read_mesh(folder_ / "hat.obj").positions; }
  Positions settled() const { return carried_of(editor_->state())[0]->positions(); }
  double moved() const { return largest_distance(hat(), at_rest()); }
};

TEST_F(AnEditorThatCarries, LetsItFollowTheHandAndLeavesItWhereTheResultHasIt) {
  EXPECT_LT(moved(), kVisible);
  ASSERT_NE(editor_->view().carried().drawn()[1].points, nullptr);
  begin_drag(kRight);
  update_until([&] { return moved() > 0.2; });
  const Positions last = at_rest_in_the_hand();
  send(press(0.5 * kWindow + kRight));
  EXPECT_LT(largest_distance(hat(), last), kVisible) << "until the result is there";
  update_until([&] { return editor_->state().settled != nullptr; });
  EXPECT_LT(largest_distance(hat(), last), kLeftOpen);
  EXPECT_LT(largest_distance(hat(), settled()), kVisible);

  editor_->view().show_before(true);
  EXPECT_LT(moved(), kVisible);
  editor_->view().show_before(false);
  EXPECT_LT(largest_distance(hat(), settled()), kVisible);
  editor_->actions().undo();
  editor_->actions().undo();
  EXPECT_LT(moved(), kVisible);
  editor_->actions().redo();
  editor_->actions().redo();
  EXPECT_LT(largest_distance(hat(), settled()), kVisible);
}

TEST_F(AnEditorThatCarries, PutsItBackWhereADragIsGivenUp) {
  begin_drag(kRight);
  update_until([&] { return moved() > 0.2; });
  send(key(kEscape));
  editor_->update();
  EXPECT_LT(moved(), kVisible);
  // What was under way comes to nothing.
  for (int k = 0; k < 20; ++k) update_until([] { return true; });
  EXPECT_LT(moved(), kVisible);
}

TEST_F(AnEditorThatCarries, DrawsWhatIsOnTheListAlone) {
  editor_->actions().perform(StopCarrying{folder_ / "hat.obj"});
  ASSERT_EQ(editor_->view().carried().drawn().size(), 1U);
  EXPECT_NE(editor_->view().carried().drawn()[0].points, nullptr);
  const Bounds without = editor_->bounds();
  editor_->actions().undo();
  EXPECT_EQ(editor_->view().carried().drawn().size(), 2U);
  EXPECT_GT(editor_->bounds().max.z(), without.max.z() + 0.2);
}

TEST_F(AnEditorThatCarries, MakesItAnewOnAnotherDevice) {
  editor_->actions().perform(MoveHandle{0, bent()});
  update_until([&] { return editor_->state().settled != nullptr; });
  editor_->release_device();
  context_ = std::make_shared<gpu::Context>();
  editor_->use_device(context_);
  EXPECT_LT(largest_distance(hat(), settled()), kVisible);
  EXPECT_GT(moved(), 0.3);
}

}  // namespace
}  // namespace lapwing::viewer::test
