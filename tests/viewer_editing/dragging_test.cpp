// Tests what the viewer shows during a drag, after it, and when the user cancels it.
#include <gtest/gtest.h>

#include "lapwing/deform/shape_measures.h"
#include "lapwing/mesh/shapes.h"
#include "viewer_editing/an_editor.h"

namespace lapwing::viewer::test {
namespace {

TEST_F(AnEditor, DragThatIsGivenUpLeavesNothing) {
  for (const InputEvent& end :
       {key(kEscape), at(InputKind::press, 0.5 * kWindow, MouseButton::right)}) {
    begin_drag(kRight);
    editor_->update();
    EXPECT_GT(head_moved(), 0.2);
    send(end);
    editor_->update();
    EXPECT_FALSE(editor_->tool().is_dragging());
    EXPECT_LT(largest_distance(on_screen(), rest()), kVisible);
    EXPECT_FALSE(is_moved(editor_->state()));
    EXPECT_EQ(editor_->session().history().done(), 0U);
  }
}

TEST_F(AnEditor, WhatSettledOfADragThatIsGivenUpNeverShows) {
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
  EXPECT_FALSE(editor_->session().take_live_result().has_value());
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

TEST_F(AnEditor, ADragIsUndoneAndRedoneWithItsResultAsOneStep) {
  begin_drag(kRight);
  send(key(kEnter));
  wait_until_ready();
  const Positions settled = on_screen();
  ASSERT_FALSE(needs_settling(editor_->state()));
  editor_->actions().undo();
  editor_->update();
  EXPECT_LT(largest_distance(on_screen(), rest()), kVisible);
  editor_->actions().redo();
  editor_->update();
  EXPECT_EQ(on_screen(), settled);
  EXPECT_EQ(editor_->session().history().done(), 1U);
}

TEST_F(AnEditor, AnotherHandleInHandIsDraggedByItsOwnColumnsFromWhereTheFirstIs) {
  editor_->actions().perform(Choose{kSecondHandle, box(1.4, 1.7)});
  wait_until_ready();
  editor_->tool().choose({Part::Role::handle, 0});
  editor_->actions().perform(MoveHandle{0, bent()});
  wait_until_ready();
  const Positions before = on_screen();
  editor_->tool().choose({Part::Role::handle, 1});
  editor_->tool().take(Action::take_move);
  wait_for_columns();
  begin_drag(kRight);
  editor_->update();
  const Index v = editor_->state().selection.handles[1].vertices.front();
  EXPECT_GT(on_screen()[v].x() - before[v].x(), 0.1);
  const Index head = editor_->state().selection.handles[0].vertices.front();
  EXPECT_LT((on_screen()[head] - before[head]).norm(), 0.05) << "the first stays where it is";
  send(key(kEscape));
  editor_->update();
  EXPECT_EQ(on_screen(), before);
}

TEST_F(AnEditor, AKeyDragsFromTheCursorAlsoIfItMovedWithAnotherTool) {
  const Vector2d middle = 0.5 * kWindow;
  editor_->tool().take(Action::take_disk);
  send(move_to(middle));
  editor_->tool().take(Action::take_move);
  send(key('G'));
  send(move_to(middle + Vector2d(1.0, 0.0)));
  ASSERT_TRUE(editor_->tool().is_dragging());
  const double way = view_.projection().length_of_pixel(
      handle_centroid(editor_->state(), editor_->tool().handle()));
  const auto move = std::get<SimilarityMove>(editor_->tool().tools().gizmo.move().value());
  EXPECT_NEAR(move.translate.norm(), way, 0.1 * way);
}

TEST_F(AnEditor, UploadsTheMeshOnceAndOfAResultWhatMoves) {
  // That of the editor has the worker's uploads, too.
  const auto context = std::make_shared<gpu::Context>();
  const auto uploaded = [&] { return context->transfers().uploaded; };
  ShownSurface shown(editor_->state().rest);
  shown.take(editor_->state());
  shown.use_device(context);
  const std::uint64_t opened = uploaded();
  shown.show_still();
  EXPECT_EQ(uploaded(), opened);

  turn_and_settle(60.0);
  shown.take(editor_->state());
  shown.show_still();
  const std::vector<Index>& moved = editor_->state().settled->vertices;
  const std::size_t affected =
      with_ring_neighbours(moved, editor_->state().rest->topology().rings).size();
  ASSERT_LT(affected, rest().size());
  constexpr std::uint64_t kNoParameters = 2 * 16;
  EXPECT_LE(uploaded() - opened, moved.size() * (16 + 4) + affected * 4 + kNoParameters);
  EXPECT_GT(uploaded(), opened);
}

TEST_F(AnEditor, ASettledHandleTakenHoldOfAgainMovesNothing) {
  turn_and_settle(80.0);
  const Positions before = on_screen();
  for (const bool live : {true, false}) {
    editor_->drag().set_wants_to_settle(live);
    for (const char mode : {'G', 'R', 'S'}) {
      send(move_to(0.5 * kWindow));
      send(key(mode));
      editor_->update();
      EXPECT_LT(largest_distance(on_screen(), before), kNothing * diagonal()) << mode;
      wait_until_ready();
      EXPECT_LT(largest_distance(on_screen(), before), kNothing * diagonal()) << mode;
      send(key(kEnter));
      editor_->update();
      EXPECT_EQ(on_screen(), before) << mode;
    }
  }
}

TEST_F(AnEditor, NorDoesItInThePreview) {
  turn_and_settle(80.0);
  const Positions before = on_screen();
  prepare_the_preview_alone();
  begin_drag({0.0, 0.0});
  editor_->update();
  EXPECT_EQ(editor_->view().device().source(), SurfaceSource::preview);
  EXPECT_LT(largest_distance(on_screen(), before), kNothing * diagonal());
  send(move_to(0.5 * kWindow + 0.1 * kRight));
  editor_->update();
  const double moved = largest_distance(on_screen(), before);
  EXPECT_GT(moved, 0.01);
  EXPECT_LT(moved, 0.2) << "from there on";
}

TEST_F(AnEditor, WhatADragShowsIsWhatItComesTo) {
  turn_and_settle(60.0);
  begin_drag(0.3 * kRight);
  for (const double share : {0.5, 0.8, 1.0}) {
    editor_->update();
    send(move_to(0.5 * kWindow + share * kRight));
  }
  wait_until_drag_is_settled();
  EXPECT_TRUE(editor_->drag().shows_live_result());
  const Positions seen = on_screen();
  hold_worker();
  send(key(kEnter));
  editor_->update();
  EXPECT_LT(largest_distance(on_screen(), seen), kNothing * diagonal()) << "until it comes";
  let_worker_go();
  wait_until_ready();
  EXPECT_EQ(editor_->view().device().source(), SurfaceSource::still);
  EXPECT_LT(largest_distance(on_screen(), seen), kSettled * diagonal());
  EXPECT_EQ(editor_->session().history().done(), 2U) << "two moves, each with its result";
}

TEST_F(AnEditor, ATypedMoveGoesOnFromTheSurfaceAsItStands) {
  turn_and_settle(80.0);
  const Positions before = on_screen();
  prepare_the_preview_alone();
  editor_->actions().perform(MoveHandle{0, twisted(81.0)});
  editor_->update();
  EXPECT_LT(largest_distance(on_screen(), before), 0.05);
}

TEST_F(AnEditor, ADragNeverShowsAWorseSurfaceThanWhatItComesTo) {
  const auto stretch = [&] {
    const Topology& topology = editor_->state().rest->topology();
    return edge_stretch(editor_->state().selection.roi.vertices, topology, rest(), on_screen());
  };
  begin_drag({0.0, 0.0});
  for (const InputEvent& event : {key('R'), key('Z'), typed('1'), typed('5'), typed('0')}) {
    send(event);
  }
  // Nothing settles yet, as on a machine that is slow.
  hold_worker();
  editor_->update();
  double worst = stretch();
  send(key(kEnter));
  editor_->update();
  worst = std::max(worst, stretch());
  let_worker_go();
  update_until([&] {
    worst = std::max(worst, stretch());
    return !needs_settling(editor_->state());
  });
  EXPECT_LT(worst, 1.1 * stretch());
}

// The camera's near and far planes hold the bounds: what is outside would be cut off.
TEST_F(AnEditor, TheBoundsHoldWhatADragShows) {
  begin_drag({0.0, 0.0});
  for (const InputEvent& event : {key('Z'), typed('-'), typed('1')}) send(event);
  wait_until_drag_is_settled();
  const Bounds shown = bounds_of(on_screen());
  const Bounds held = editor_->bounds();
  EXPECT_GT((bounds_of(rest()).min - shown.min).head<2>().maxCoeff(), 0.1) << "the tube bulges";
  EXPECT_LT((united(held, shown).max - held.max).norm(), kVisible);
  EXPECT_LT((united(held, shown).min - held.min).norm(), kVisible);
}

TEST_F(AnEditor, WithoutSettlingADragIsTheLinearResponse) {
  editor_->actions().perform(SetParameters{{{.settle = std::nullopt}}});
  wait_until_ready();
  EXPECT_FALSE(editor_->drag().settles());
  begin_drag(kRight);
  editor_->update();
  EXPECT_EQ(editor_->view().device().source(), SurfaceSource::exact);
  const Positions seen = on_screen();
  send(key(kEnter));
  wait_until_ready();
  EXPECT_LT(largest_distance(on_screen(), seen), kVisible);
}

TEST_F(AnEditor, PickingInADragAsksNothingOfTheDevice) {
  begin_drag(kRight);
  wait_until_drag_is_settled();
  const Vector2d somewhere = *view_.projection().to_pixel({0.0, 0.0, 1.5});
  const Vector2d middle = somewhere.array().floor() + 0.5;
  const std::uint64_t completed = context_->completed();
  const auto seen = editor_->view().shown().pick(view_, middle);
  EXPECT_EQ(context_->completed(), completed);
  const auto expected = pick_surface(editor_->view().shown().topology(), on_screen(),
                                     view_.projection().ray_through(middle));
  ASSERT_TRUE(seen && expected);
  EXPECT_EQ(seen->triangle, expected->triangle);
  EXPECT_LT((seen->position - expected->position).norm(), 1e-3);
}

// A step has made other triangles than the mesh was opened with.
class Before : public AnEditor {
 protected:
  void SetUp() override {
    AnEditor::SetUp();
    if (IsSkipped()) return;
    editor_.emplace(
        EditStart{History(chosen_tube()), opened_, {}, {}, folder_.path()}, context_,
        [](const Message&) {}, [] {});
    wait_until_ready();
  }

  const std::shared_ptr<const Mesh> opened_ = std::make_shared<const Mesh>(icosphere(1));
};

TEST_F(Before, ShowsTheMeshThatWasOpened) {
  editor_->view().show_before(true);
  editor_->update();
  EXPECT_EQ(on_screen().size(), opened_->vertex_count());
  editor_->view().show_before(false);
  editor_->update();
  EXPECT_EQ(on_screen().size(), rest().size());
}

TEST_F(Before, ADragThatBeginsThereShowsTheSurfaceThatItMoves) {
  editor_->view().show_before(true);
  editor_->update();
  begin_drag(kRight);
  editor_->update();
  ASSERT_EQ(on_screen().size(), rest().size());
  EXPECT_GT(head_moved(), 0.0);
}

}  // namespace
}  // namespace lapwing::viewer::test
