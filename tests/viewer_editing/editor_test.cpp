#include "editing/editor.h"

#include <gtest/gtest.h>

#include "editing/editor_actions.h"
#include "viewer_editing/an_editor.h"

namespace lapwing::viewer::test {
namespace {

TEST_F(AnEditor, PinIsSetAndDraggedInOneGesture) {
  ASSERT_TRUE(editor_->tool().take(Action::take_pin));
  // In the middle of the tube, where it is nearest to the eye.
  Index nearest = 0;
  for (Index v = 0; v < rest().size(); ++v) {
    if (std::abs(rest()[v].z() - 1.5) < 0.2 && rest()[v].y() < rest()[nearest].y()) nearest = v;
  }
  const Vector2d front = shown_pixel(nearest);
  send(press(front));
  ASSERT_EQ(editor_->state().selection.handles.size(), 2U);
  const Index pinned = editor_->state().selection.handles[1].vertices.front();
  EXPECT_EQ(editor_->tool().handle(), 1U);
  EXPECT_TRUE(editor_->tool().is_dragging());
  wait_until_ready();
  send(move_to(front + 0.3 * kRight));
  wait_for_live_result();
  const double dragged = on_screen()[pinned].x() - rest()[pinned].x();
  EXPECT_GT(dragged, 0.05);
  send(release(front + 0.3 * kRight));
  wait_until_ready();
  ASSERT_NE(editor_->state().settled, nullptr);
  EXPECT_NEAR(on_screen()[pinned].x() - rest()[pinned].x(), dragged, kSettled * diagonal());
  EXPECT_EQ(editor_->session().history().done(), 1U) << "one gesture, one step";
  editor_->actions().undo();
  EXPECT_EQ(editor_->state().selection.handles.size(), 1U);
  EXPECT_LT(largest_distance(on_screen(), rest()), kVisible);
  editor_->actions().redo();
  EXPECT_EQ(editor_->tool().scene_tool().hint(editor_->state(), editor_->tool().part()),
            std::string("Drag a pin, or press on another vertex to pin it."));
}

// Returns the vertex that is nearest to the camera at the height `z`.
Index front_of(const Positions& positions, double z) {
  Index nearest = 0;
  for (Index v = 0; v < positions.size(); ++v) {
    const bool is_at_height = std::abs(positions[v].z() - z) < 0.2;
    if (is_at_height && positions[v].y() < positions[nearest].y()) nearest = v;
  }
  return nearest;
}

TEST_F(AnEditor, GrabsAreOneStepOfTheHistoryEachAndOneOfTheRecipe) {
  expects_notes_ = true;
  ASSERT_TRUE(editor_->tool().take(Action::take_grab));
  const auto done = [&] { return editor_->session().history().done(); };
  const auto grab_at = [&](double z) {
    const Index grabbed = front_of(editor_->view().positions(), z);
    const Vector2d from = *view_.projection().to_pixel(editor_->view().positions()[grabbed]);
    send(press(from));
    EXPECT_TRUE(editor_->tool().is_dragging());
    wait_until_ready();
    const double before = on_screen()[grabbed].x();
    send(move_to(from + 0.3 * kRight));
    wait_until_drag_is_settled();
    const double dragged = on_screen()[grabbed].x() - before;
    EXPECT_GT(dragged, 0.05);
    send(release(from + 0.3 * kRight));
    wait_until_ready();
    EXPECT_NE(editor_->state().settled, nullptr);
    EXPECT_NEAR(on_screen()[grabbed].x() - before, dragged, kSettled * diagonal());
  };
  grab_at(3.0);
  EXPECT_EQ(done(), 1U);
  EXPECT_EQ(editor_->state().moves.at(0).orientation, HandleOrientation::free);
  const Positions first = on_screen();
  grab_at(1.0);
  EXPECT_EQ(done(), 2U);
  EXPECT_EQ(editor_->state().steps.size(), 1U);
  editor_->actions().undo();
  editor_->update();
  EXPECT_LT(largest_distance(on_screen(), first), kVisible);
}

TEST_F(AnEditor, AGrabThatMovesNothingIsNoStep) {
  ASSERT_TRUE(editor_->tool().take(Action::take_grab));
  expects_notes_ = true;
  const EditSelection before = editor_->state().selection;
  const Vector2d front = shown_pixel(front_of(rest(), 1.0));
  send(press(front));
  ASSERT_EQ(editor_->session().history().done(), 1U);
  send(release(front));
  EXPECT_EQ(editor_->session().history().done(), 0U);
  EXPECT_EQ(editor_->state().selection, before);
  send(press(front));
  send(move_to(front + kRight));
  send(key(kEscape));
  EXPECT_FALSE(editor_->tool().is_dragging());
  EXPECT_EQ(editor_->state().selection, before);
  editor_->update();
  EXPECT_LT(largest_distance(on_screen(), rest()), kVisible);
}

TEST_F(AnEditor, ChoosesAllOfThePartThatTheToolInHandChooses) {
  const EditSelection& selection = editor_->state().selection;
  editor_->tool().take(Action::take_disk);
  editor_->tool().choose(kHandle);
  EXPECT_TRUE(perform_on(*editor_, Action::select_all));
  EXPECT_EQ(selection.handles.at(0).vertices, selection.roi.vertices);
  EXPECT_EQ(editor_->tool().part(), kHandle);
  editor_->actions().undo();
  // The gizmo chooses no part, so all vertices are added to the ROI.
  editor_->tool().take(Action::take_move);
  const VertexSet handle = selection.handles.at(0).vertices;
  EXPECT_TRUE(perform_on(*editor_, Action::select_all));
  EXPECT_EQ(selection.roi.vertices.size(), rest().size());
  EXPECT_EQ(selection.handles.at(0).vertices, handle);
}

TEST_F(AnEditor, GoesOnToTheHandleAfterAllOfTheRegion) {
  editor_->actions().perform(NewEdit{});
  editor_->tool().take(Action::take_ruler);
  EXPECT_TRUE(perform_on(*editor_, Action::select_all));
  EXPECT_EQ(editor_->state().selection.roi.vertices.size(), rest().size());
  EXPECT_EQ(editor_->tool().part(), kHandle);
  EXPECT_EQ(editor_->tool().row()->action, Action::take_disk);
}

TEST_F(AnEditor, CarriesOutTheRemediesOfWarnings) {
  turn_and_settle(20.0);
  const std::size_t before = editor_->state().selection.roi.vertices.size();
  const std::vector<HandleMove> moves = editor_->state().moves;
  carry_out(*editor_, Remedy::enlarge_region);
  wait_until_ready();
  EXPECT_GT(editor_->state().selection.roi.vertices.size(), before);
  EXPECT_EQ(editor_->state().moves, moves);
  EXPECT_NE(editor_->state().settled, nullptr) << "refined in the larger region";
  EXPECT_EQ(editor_->session().history().names().back(), "Enlarge region");
  carry_out(*editor_, Remedy::undo);
  EXPECT_EQ(editor_->state().selection.roi.vertices.size(), before);
  const int iterations = editor_->state().parameters.settle->max_iterations;
  carry_out(*editor_, Remedy::raise_iterations);
  EXPECT_EQ(editor_->state().parameters.settle->max_iterations, 2 * iterations);
  carry_out(*editor_, Remedy::hold_exactly);
  EXPECT_TRUE(editor_->state().parameters.hard);
  carry_out(*editor_, Remedy::select_region);
  EXPECT_EQ(editor_->tool().part(), kRoi);
  EXPECT_TRUE(editor_->tool().chooses_parts());
}

TEST_F(AnEditor, SelectsOnlyWhatIsSeenAtFirst) {
  EXPECT_FALSE(editor_->tool().tools().paint.options().through);
}

TEST_F(AnEditor, KnowsWhetherSomethingHoldsTheSurface) {
  EXPECT_FALSE(editor_->moves_as_a_whole());
  editor_->actions().perform(Choose{kRoi, {AllVertices{}}});
  EXPECT_FALSE(editor_->moves_as_a_whole()) << "the rim at the foot is the belt";
  editor_->actions().perform(Choose{kBelt, listed({})});
  EXPECT_TRUE(editor_->moves_as_a_whole());
  editor_->actions().perform(Choose{kSecondHandle, box(0.0, 0.2)});
  EXPECT_FALSE(editor_->moves_as_a_whole());
}

TEST_F(AnEditor, TakesTheDiskWhenAPartIsChosenAndNoToolInHandChoosesParts) {
  ASSERT_TRUE(editor_->tool().take(Action::take_grab));
  EXPECT_FALSE(editor_->tool().chooses_parts());
  editor_->tool().begin_choosing(kRoi);
  EXPECT_EQ(editor_->tool().row()->action, Action::take_disk);
  editor_->tool().take(Action::take_brush);
  editor_->tool().begin_choosing(kRoi);
  EXPECT_EQ(editor_->tool().row()->action, Action::take_brush);
}

TEST_F(AnEditor, AnotherFeatureAngleKeepsTheSurfaceAndTheDrag) {
  const auto normals = [&] { return editor_->view().device().shown().normals().size(); };
  turn_and_settle(30.0);
  const Positions settled = on_screen();
  editor_->view().set_feature_angle(0.5);
  EXPECT_GT(normals(), rest().size()) << "each triangle has its own";
  EXPECT_LT(largest_distance(on_screen(), settled), kVisible);
  editor_->view().set_feature_angle(180.0);
  EXPECT_EQ(normals(), rest().size());
  wait_until_ready();
  begin_drag(kRight);
  editor_->view().set_feature_angle(0.5);
  EXPECT_EQ(normals(), rest().size()) << "not during a drag";
  editor_->update();
  EXPECT_GT(largest_distance(on_screen(), settled), kVisible);
}

TEST_F(AnEditor, SizingADiskIsOneStepHoweverManyNotches) {
  const auto roi = [&] { return editor_->state().selection.roi.vertices.size(); };
  const auto done = [&] { return editor_->session().history().done(); };
  turn_and_settle(30.0);
  expects_notes_ = true;
  const Positions settled = on_screen();
  editor_->tool().choose(kRoi);
  editor_->tool().take(Action::take_disk);
  const Vector2d middle = 0.5 * kWindow;
  send(press(middle));
  send(release(middle));
  ASSERT_EQ(done(), 2U) << "a click chooses";
  const std::size_t clicked = roi();
  for (int notch = 0; notch < 5; ++notch) send(scrolled(middle, 1.0, kSizes));
  EXPECT_GT(roi(), clicked);
  EXPECT_EQ(done(), 2U) << "and what is clicked is sized as one step";
  for (int notch = 0; notch < 5; ++notch) send(scrolled(middle, -1.0, kSizes));
  EXPECT_EQ(roi(), clicked);
  drag_mouse(middle, middle + Vector2d(0.0, 60.0));
  ASSERT_EQ(done(), 3U);
  editor_->tool().take(Action::take_disk);
  const std::size_t dragged = roi();
  for (int notch = 0; notch < 3; ++notch) send(scrolled(middle, 1.0, kSizes));
  EXPECT_EQ(done(), 4U) << "what was dragged is sized in a step of its own";
  EXPECT_GT(roi(), dragged);
  editor_->actions().undo();
  EXPECT_EQ(roi(), dragged);
  editor_->actions().undo();
  EXPECT_EQ(roi(), clicked);
  editor_->update();
  EXPECT_LT(largest_distance(on_screen(), settled), kVisible);
}

TEST_F(AnEditor, AGripSizesTheRoiInOneStepWhileItsHandleComesNext) {
  expects_notes_ = true;
  editor_->actions().perform(Choose{kRoi, box(2.3, 4.0)});
  editor_->tool().choose(kRoi);
  editor_->tool().take(Action::take_disk);
  const Vector2d middle = 0.5 * kWindow + Vector2d(0.0, 60.0);
  const Vector2d rim = middle + Vector2d(0.0, 70.0);
  drag_mouse(middle, rim);
  send(move_to(middle));
  ASSERT_EQ(editor_->tool().part().role, Part::Role::handle);
  const std::size_t done = editor_->session().history().done();
  const std::size_t before = editor_->state().selection.roi.vertices.size();
  Vector2d lowest = middle;
  for (const RimGrip& grip : editor_->tool().scene_tool().marks().grips) {
    const Vector2d pixel = *view_.projection().to_pixel(grip.position);
    if (grip.faces_eye(view_.projection()) && pixel.y() > lowest.y()) lowest = pixel;
  }
  const Vector2d wider = lowest + Vector2d(0.0, 40.0);
  drag_mouse(lowest, wider);
  EXPECT_GT(editor_->state().selection.roi.vertices.size(), before);
  EXPECT_EQ(editor_->session().history().done(), done + 1);
  EXPECT_EQ(editor_->tool().part().role, Part::Role::handle) << "the handle still comes next";
  editor_->actions().undo();
  EXPECT_EQ(editor_->state().selection.roi.vertices.size(), before);
}

TEST_F(AnEditor, APivotIsPickedOnTheSurfaceAndIsNoStep) {
  const Vector2d somewhere = 0.5 * kWindow;
  editor_->input().begin_picking_pivot();
  EXPECT_NE(std::string(editor_->input().hint()).find("pivot"), std::string::npos);
  send(key(kEscape));
  EXPECT_FALSE(editor_->input().picks_pivot());
  editor_->input().begin_picking_pivot();
  const auto seen = editor_->view().shown().pick(view_, somewhere);
  ASSERT_TRUE(seen);
  send(press(somewhere));
  EXPECT_EQ(editor_->tool().tools().gizmo.choices().pivot, GizmoPivot::point);
  EXPECT_EQ(editor_->tool().tools().gizmo.choices().point, seen->position);
  EXPECT_FALSE(editor_->tool().is_dragging());
  EXPECT_EQ(editor_->session().history().done(), 0U);
}

TEST_F(AnEditor, TheGizmosAxesGoAroundByAKeyAndAreNoStep) {
  expects_notes_ = true;
  std::vector<GizmoAxes> seen;
  for (int k = 0; k < 3; ++k) {
    ASSERT_TRUE(perform_on(*editor_, Action::next_gizmo_axes));
    seen.push_back(editor_->tool().tools().gizmo.choices().axes);
    EXPECT_NE(said_, "");
  }
  EXPECT_EQ(seen, (std::vector{GizmoAxes::local, GizmoAxes::normal, GizmoAxes::world}));
  ASSERT_TRUE(perform_on(*editor_, Action::toggle_sticking));
  EXPECT_TRUE(editor_->tool().tools().gizmo.choices().sticks_to_surface);
  EXPECT_EQ(editor_->session().history().done(), 0U);
}

TEST_F(AnEditor, AMeasureStaysWithOtherToolsAndGoesWithADrag) {
  const auto pixel = [&](double z) { return *view_.projection().to_pixel({0.0, -0.5, z}); };
  editor_->tool().take(Action::take_ruler);
  for (const double z : {0.2, 2.9}) {
    send(press(pixel(z)));
    send(release(pixel(z)));
  }
  ASSERT_TRUE(editor_->tool().tools().ruler.has_both_ends());
  const double before = editor_->tool().tools().ruler.straight();
  editor_->tool().take(Action::take_move);
  begin_drag(kRight);
  wait_for_live_result();
  EXPECT_GT(editor_->tool().tools().ruler.straight(), before + 0.02);
  send(key(kEscape));
  editor_->update();
  EXPECT_NEAR(editor_->tool().tools().ruler.straight(), before, kVisible);
  EXPECT_EQ(editor_->session().history().done(), 0U);
}

TEST_F(AnEditor, NothingIsSaidOfAMirrorThatIsOff) {
  expects_notes_ = true;
  editor_->actions().perform(SetMirror{MirrorPlane{Vector3d::Zero(), Vector3d::UnitX()}});
  EXPECT_NE(said_.find("Mirror on"), std::string::npos) << said_;
  ASSERT_TRUE(perform_on(*editor_, Action::toggle_mirror));
  EXPECT_FALSE(editor_->state().selection.mirror);
  EXPECT_EQ(said_, "Mirror off");
}

// Of the tube its foot, below z = 0.3, is not in the ROI.
TEST_F(AnEditor, AHandleThatSticksGoesToTheSurfaceBesideTheRoi) {
  editor_->tool().tools().gizmo.set_choices({.sticks_to_surface = true});
  const Vector2d foot = *view_.projection().to_pixel({0.1, -0.5, 0.15});
  send(move_to(0.5 * kWindow));
  send(key('G'));
  send(move_to(foot));
  send(key(kEnter));
  const Vector3d middle =
      to_affine(editor_->state().moves[0].move, handle_centroid(editor_->state(), 0)) *
      handle_centroid(editor_->state(), 0);
  const auto seen =
      pick_surface(editor_->state().rest->topology(), rest(), view_.projection().ray_through(foot));
  ASSERT_TRUE(seen);
  EXPECT_LT((middle - seen->position).norm(), 1e-9);
}

// The middle of the tube is away from the head that was turned.
TEST_F(AnEditor, ADiskElsewhereBeginsANewEditWithANote) {
  editor_->actions().perform(Choose{kRoi, box(2.3, 4.0)});
  wait_until_ready();
  turn_and_settle(30.0);
  const Positions settled = on_screen();
  expects_notes_ = true;
  ASSERT_EQ(editor_->tool().part().role, Part::Role::handle);
  editor_->tool().take(Action::take_disk);
  const Vector2d elsewhere = 0.5 * kWindow + Vector2d(0.0, 80.0);
  drag_mouse(elsewhere, elsewhere + Vector2d(0.0, 80.0));
  EXPECT_NE(said_.find("New edit"), std::string::npos) << said_;
  EXPECT_TRUE(editor_->state().selection.handles.empty());
  EXPECT_EQ(editor_->state().steps.size(), 1U) << "the first stays";
  EXPECT_EQ(editor_->tool().part(), kHandle) << "and its handle comes next";
  EXPECT_TRUE(editor_->tool().is(editor_->tool().scene_tool()) && !editor_->tool().has_gizmo());
  editor_->update();
  EXPECT_LT(largest_distance(on_screen(), settled), kVisible);
  drag_mouse(elsewhere, elsewhere + Vector2d(0.0, 25.0));
  ASSERT_EQ(editor_->state().selection.handles.size(), 1U);
  wait_until_ready();
  editor_->actions().perform(MoveHandle{0, bent()});
  wait_until_ready();
  EXPECT_FALSE(needs_settling(editor_->state()));
  EXPECT_FALSE(handles_leave_roi(editor_->state().selection));
  EXPECT_GT(largest_distance(on_screen(), settled), 0.01) << "by a handle of few vertices";
}

TEST_F(AnEditor, AStrokeElsewhereBeginsANewEditOnceTheLastHasMoved) {
  editor_->actions().perform(Choose{kRoi, box(2.3, 4.0)});
  wait_until_ready();
  turn_and_settle(30.0);
  expects_notes_ = true;
  editor_->tool().take(Action::take_box);
  editor_->tool().choose(kRoi);
  const std::size_t done = editor_->session().history().done();
  const Vector2d corner = 0.5 * kWindow + Vector2d(-60.0, 60.0);
  drag_mouse(corner, corner + Vector2d(120.0, 60.0));
  EXPECT_NE(said_.find("New edit"), std::string::npos) << said_;
  EXPECT_TRUE(editor_->state().selection.handles.empty());
  EXPECT_EQ(editor_->session().history().done(), done + 1) << "one stroke, one step";
  editor_->actions().undo();
  EXPECT_EQ(editor_->state().selection.handles.size(), 1U);
}

TEST_F(AnEditor, PaintedStiffnessIsShownAndSettlesTheEditAgain) {
  turn_and_settle(60.0);
  const Positions usual = on_screen();
  ASSERT_TRUE(editor_->tool().take(Action::take_stiffness));
  editor_->tool().tools().stiffness.brush().through = true;
  EXPECT_FALSE(editor_->tool().chooses_parts());
  const Vector2d middle = 0.5 * kWindow;
  drag_mouse(middle - Vector2d(40.0, 0.0), middle + Vector2d(40.0, 0.0));
  wait_until_ready();
  const std::vector<StiffnessSpec>& stiffness = editor_->state().selection.stiffness;
  ASSERT_EQ(stiffness.size(), 1U);
  EXPECT_EQ(stiffness[0].factor, kRigidStiffness);
  const VertexSet painted = resolve(stiffness[0].region, *editor_->state().rest);
  const std::vector<VertexClass> classes = stiffness_classes(editor_->state(), stiffness);
  for (const Index v : painted) {
    EXPECT_EQ(classes[v], drawn_by_handle(VertexClass::roi, 1.0));
  }
  EXPECT_GT(largest_distance(on_screen(), usual), 1e-3);
  editor_->actions().undo();
  wait_until_ready();
  EXPECT_TRUE(editor_->state().selection.stiffness.empty());
  EXPECT_LT(largest_distance(on_screen(), usual), kVisible);
}

TEST_F(AnEditor, ANewEditBeginsOnceTheDragHasSettled) {
  expects_notes_ = true;
  begin_drag(kRight);
  send(key(kEnter));
  new_edit(*editor_);
  update_until([&] { return editor_->state().selection.roi.vertices.empty(); });
  EXPECT_EQ(editor_->state().steps.size(), 1U);
  EXPECT_EQ(editor_->tool().part(), kRoi);
  EXPECT_FALSE(editor_->tool().has_gizmo());
  EXPECT_EQ(editor_->session().history().done(), 2U);
}

TEST_F(AnEditor, TheWheelAloneIsTheCameras) {
  turn_and_settle(30.0);
  for (const ToolRow& row : tool_rows()) {
    editor_->tool().take(row);
    for (const Part& part : {kRoi, kHandle}) {
      editor_->tool().choose(part);
      EXPECT_FALSE(editor_->input().handle(scrolled(0.5 * kWindow, 2.0), view_).taken) << row.name;
    }
  }
  EXPECT_EQ(editor_->session().history().done(), 1U);
}

}  // namespace
}  // namespace lapwing::viewer::test
