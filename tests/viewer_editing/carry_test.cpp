// What is carried along is on the screen where the surface is.
#include <chrono>
#include <fstream>
#include <thread>

#include <gtest/gtest.h>

#include "editing/editor.h"
#include "io/temporary_folder.h"
#include "lapwing/gpu/context.h"
#include "lapwing/io/mesh_file.h"
#include "lapwing/mesh/shapes.h"
#include "lapwing/mesh/transform.h"
#include "support/gpu.h"
#include "viewer_state/test_view.h"
#include "viewer_state/tube_edit.h"

namespace lapwing::viewer::test {
namespace {

using lapwing::test::largest_distance;

// What rounding to float32 does.
constexpr double kRoundedOff = 1e-5;
// Of what settling to its tolerance leaves open.
constexpr double kLeftOpen = 5e-3;

// The head of a tube is in hand; over it is a hat, and around it are points.
class AnEditorThatCarries : public ::testing::Test {
 protected:
  void SetUp() override {
    LAPWING_NEEDS_GPU();
    Mesh hat = icosphere(2);
    transform(hat, Eigen::Translation3d(0.0, 0.0, 3.1) * Eigen::Scaling(0.3));
    write_mesh(hat, folder_ / "hat.obj");
    std::ofstream(folder_ / "points.csv") << "0.9,0,2.9\n0,0.9,2.9\n0.9,0,0.1\n";
    AppState state = chosen_tube();
    for (const char* file : {"hat.obj", "points.csv"}) {
      state = apply(std::move(state), CarryAlong{open_carried(folder_ / file)});
    }
    view_.camera = fit(state.rest->positions, {-Vector3d::UnitY(), Vector3d::UnitZ()},
                       kWindow.x() / kWindow.y());
    view_.size = kWindow;
    context_ = std::make_shared<gpu::Context>();
    editor_.emplace(
        EditStart{History(state), state.rest, {}, {}, folder_.path()}, context_,
        [](const Message& said) { EXPECT_EQ(said.text, ""); }, [] {});
    update_until([&] { return is_ready(); });
  }

  bool is_ready() const {
    return editor_->session().preparation().status().phase == PreparationStatus::Phase::ready;
  }
  void update_until(const std::function<bool()>& happened) {
    do {
      editor_->update();
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    } while (!happened());
  }
  void begin_drag() {
    const Vector2d middle = 0.5 * kWindow;
    editor_->handle(move_to(middle), view_);
    editor_->handle(key('G'), view_);
    editor_->handle(move_to(middle + Vector2d(150.0, 0.0)), view_);
    ASSERT_TRUE(editor_->is_dragging());
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
      const Positions before = std::exchange(surface, editor_->surface().shown().positions());
      still = is_ready() && hats == hats_before && surface == before ? still + 1 : 0;
      std::this_thread::sleep_for(std::chrono::milliseconds(30));
      return still == kUpdates;
    });
    return hats;
  }
  Positions hat() const { return editor_->carried().drawn()[0].surface->positions(); }
  Positions at_rest() const { return read_mesh(folder_ / "hat.obj").positions; }
  Positions settled() const { return carried_of(editor_->state())[0]->positions(); }
  double moved() const { return largest_distance(hat(), at_rest()); }

  TemporaryFolder folder_;
  ViewFrame view_;
  std::shared_ptr<gpu::Context> context_;
  std::optional<Editor> editor_;
};

TEST_F(AnEditorThatCarries, LetsItFollowTheHandAndLeavesItWhereTheResultHasIt) {
  EXPECT_LT(moved(), kRoundedOff);
  ASSERT_NE(editor_->carried().drawn()[1].points, nullptr);
  begin_drag();
  update_until([&] { return moved() > 0.2; });
  const Positions last = at_rest_in_the_hand();
  editor_->handle(at(InputKind::press, 0.5 * kWindow + Vector2d(150.0, 0.0), MouseButton::left),
                  view_);
  EXPECT_LT(largest_distance(hat(), last), kRoundedOff) << "until the result is there";
  update_until([&] { return editor_->state().settled != nullptr; });
  EXPECT_LT(largest_distance(hat(), last), kLeftOpen);
  EXPECT_LT(largest_distance(hat(), settled()), kRoundedOff);

  editor_->show_before(true);
  EXPECT_LT(moved(), kRoundedOff);
  editor_->show_before(false);
  EXPECT_LT(largest_distance(hat(), settled()), kRoundedOff);
  editor_->undo();
  editor_->undo();
  EXPECT_LT(moved(), kRoundedOff);
  editor_->redo();
  editor_->redo();
  EXPECT_LT(largest_distance(hat(), settled()), kRoundedOff);
}

TEST_F(AnEditorThatCarries, PutsItBackWhereADragIsGivenUp) {
  begin_drag();
  update_until([&] { return moved() > 0.2; });
  editor_->handle(key(kEscape), view_);
  editor_->update();
  EXPECT_LT(moved(), kRoundedOff);
  // What was under way comes to nothing.
  for (int k = 0; k < 20; ++k) update_until([] { return true; });
  EXPECT_LT(moved(), kRoundedOff);
}

TEST_F(AnEditorThatCarries, DrawsWhatIsOnTheListAlone) {
  editor_->perform(StopCarrying{folder_ / "hat.obj"});
  ASSERT_EQ(editor_->carried().drawn().size(), 1U);
  EXPECT_NE(editor_->carried().drawn()[0].points, nullptr);
  const Bounds without = editor_->bounds();
  editor_->undo();
  EXPECT_EQ(editor_->carried().drawn().size(), 2U);
  EXPECT_GT(editor_->bounds().max.z(), without.max.z() + 0.2);
}

TEST_F(AnEditorThatCarries, MakesItAnewOnAnotherDevice) {
  editor_->perform(MoveHandle{0, bent()});
  update_until([&] { return editor_->state().settled != nullptr; });
  editor_->release_device();
  context_ = std::make_shared<gpu::Context>();
  editor_->use_device(context_);
  EXPECT_LT(largest_distance(hat(), settled()), kRoundedOff);
  EXPECT_GT(moved(), 0.3);
}

}  // namespace
}  // namespace lapwing::viewer::test
