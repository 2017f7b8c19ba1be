#include "state/command.h"

#include <limits>
#include <numbers>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "lapwing/base/errors.h"
#include "state/app_state.h"
#include "viewer_state/tube_edit.h"

namespace lapwing::viewer::test {
namespace {

using Eigen::Affine3d;
using Eigen::AngleAxisd;
using Eigen::Vector3d;

TEST(Command, ChoosingMakesARegionThatFits) {
  const EditRegion region = edit_region(chosen_tube());
  EXPECT_EQ(region.handles.size(), 1U);
  EXPECT_FALSE(region.belt.empty());
  EXPECT_TRUE(intersect(region.belt, region.handles[0]).empty());
  EXPECT_THROW(edit_region(open_state(bumpy_tube())), InputError) << "says what is missing";
}

TEST(Command, AGrabMakesTheEditAStepAndBeginsAnotherOne) {
  const AppState before = settled_tube();
  const Grab grab{
      choose(box(0.6, 4.0), *before.rest), box(3.0, 4.0), {.transition = Transition{.width = 0.2}}};
  const AppState after = apply(before, grab);
  EXPECT_EQ(after.steps.size(), 1U);
  ASSERT_EQ(after.selection.handles.size(), 1U);
  EXPECT_EQ(after.selection.handles[0].falloff, grab.falloff);
  EXPECT_EQ(after.moves, std::vector<HandleMove>(1));
  EXPECT_NO_THROW(edit_region(after));
}

TEST(Command, ApplyLeavesTheStateItWasGiven) {
  const AppState before = settled_tube();
  const AppState copy = before;
  (void)apply(before, Choose{kRoi, box(0.6, 4.0)});
  EXPECT_TRUE(same(before, copy));
}

TEST(Command, PaintingGainsAndLosesVertices) {
  const AppState before = chosen_tube();
  const AppState after = apply(before, Paint{kRoi, {0, 1}, {100}});
  EXPECT_EQ(after.selection.roi.vertices,
            subtract(unite(before.selection.roi.vertices, {0, 1}), {100}));
}

TEST(Command, AFalloffOfAHandleAsksForAResult) {
  const AppState before = settled_tube();
  const Falloff wide{.transition = Transition{0.5}};
  const AppState after = apply(before, SetFalloff{0, wide});
  EXPECT_EQ(after.selection.handles[0].falloff, wide);
  EXPECT_TRUE(needs_settling(after));
  EXPECT_FALSE(edit_region(after).graded.empty());
  EXPECT_EQ(falloff_vertices(after.selection, *after.rest), edit_region(after).graded)
      << "what is shown is what is computed with";
  EXPECT_EQ(open_step(after).handles[0].falloff, wide);
  EXPECT_TRUE(same(apply(after, SetFalloff{0, wide}), after));
  EXPECT_THROW(apply(before, SetFalloff{0, {.weight = 0.0}}), InputError);
  EXPECT_THROW(apply(before, SetFalloff{1, wide}), InputError);
  EXPECT_THROW(apply(before, SetFalloff{0, {.field = {1.0, 0.5}}}), InputError)
      << "weights of another mesh";
}

TEST(Command, FindsAMirrorAnewWhereTheChoiceBecomesAnotherAndOnlyThere) {
  const MirrorPlane plane{{0.0, 0.0, 0.0}, {1.0, 0.0, 0.0}};
  const AppState mirrored = apply(chosen_tube(), SetMirror{plane});
  ASSERT_NE(mirrored.mirrored, nullptr);
  AppState moved = apply(mirrored, MoveHandle{0, bent()});
  EXPECT_EQ(moved.mirrored, mirrored.mirrored);
  EXPECT_EQ(apply(mirrored, Choose{kHandle, box(2.8, 4.0)}).mirrored, mirrored.mirrored)
      << "the same vertices";
  EXPECT_EQ(apply(mirrored, SetBeltWidth{*mirrored.selection.belt_fraction}).mirrored,
            mirrored.mirrored);
  EXPECT_NE(apply(mirrored, SetBeltWidth{0.3}).mirrored, mirrored.mirrored);
  EXPECT_NE(apply(mirrored, Choose{kHandle, box(2.6, 4.0)}).mirrored, mirrored.mirrored);
  EXPECT_EQ(apply(mirrored, SetMirror{}).mirrored, nullptr);
  moved = apply(moved, Settle{handles_alone(mirrored)});
  EXPECT_NE(apply(moved, Commit{}).mirrored, mirrored.mirrored) << "on another rest shape";
}

TEST(Command, PaintingTheBeltTakesItFromItsWidth) {
  AppState state = apply(chosen_tube(), Paint{kBelt, {40}, {}});
  EXPECT_FALSE(state.selection.belt_fraction.has_value());
  state = apply(state, SetBeltWidth{0.2});
  EXPECT_EQ(state.selection.belt_fraction, 0.2);
}

TEST(Command, MovesParametersAndTheBeltsWidthAskForAResultFromTheSameRestShape) {
  const AppState before = settled_tube();
  EXPECT_FALSE(needs_settling(before));
  EXPECT_TRUE(needs_settling(apply(before, MoveHandle{0, twisted(90.0)})));
  EXPECT_TRUE(needs_settling(apply(before, SetParameters{{{.hard = true}}})));
  const AppState after = apply(before, SetBeltWidth{0.3});
  EXPECT_TRUE(needs_settling(after));
  EXPECT_EQ(after.rest, before.rest);
  EXPECT_EQ(after.moves, before.moves);
  EXPECT_GT(after.selection.belt.vertices.size(), before.selection.belt.vertices.size());
}

TEST(Command, HandleBroughtBackNeedsNoResult) {
  const AppState state = apply(settled_tube(), MoveHandle{0, SimilarityMove{}});
  EXPECT_FALSE(needs_settling(state));
  EXPECT_EQ(positions_of(state), bumpy_tube().positions);
}

TEST(LastSolveOptions, ComesBackWithTheOptionsThatItHad) {
  LastSolveOptions settling;
  const EditParameters on{{.settle = SettleOptions{.tolerance = 1e-6, .max_iterations = 77}}};
  const EditParameters off{{.settle = std::nullopt}};
  EXPECT_EQ(settling.meant(on, off), off);
  EXPECT_EQ(settling.meant(off, EditParameters{}), on);
  EXPECT_EQ(settling.meant(EditParameters{}, on), on) << "what is chosen beside the switch counts";
}

TEST(Command, WhatNoRecipeCouldSayIsRefused) {
  const AppState state = settled_tube();
  for (const EditParameters& parameters :
       {EditParameters{{.detail_length = 0.0}}, EditParameters{{.detail_length = -0.1}},
        EditParameters{{.constraint_weight = 0.0}},
        EditParameters{{.settle = SettleOptions{.max_iterations = 0}}}}) {
    EXPECT_THROW(apply(state, SetParameters{parameters}), InputError);
  }
  SimilarityMove without_axis;
  without_axis.rotate.axis.setZero();
  MatrixMove endless;
  endless.matrix(1, 3) = std::numeric_limits<double>::quiet_NaN();
  for (const Move& move :
       {Move(without_axis), Move(endless), Move(SimilarityMove{.scale = Vector3d::Zero()})}) {
    EXPECT_THROW(apply(state, MoveHandle{0, move}), InputError);
  }
}

TEST(Command, AHandleThatIsMirroredIsNotMovedInParts) {
  MatrixMove mirrored;
  mirrored.matrix(0, 0) = -1e-12;
  const SetParameters in_parts{{.commit_every = 90.0}};
  EXPECT_THROW(apply(apply(chosen_tube(), in_parts), MoveHandle{0, mirrored}), InputError);
  EXPECT_THROW(apply(apply(chosen_tube(), MoveHandle{0, mirrored}), in_parts), InputError);
}

TEST(Command, CommitMovesTheRestShapeToTheResult) {
  const AppState before = settled_tube();
  const AppState after = apply(before, Commit{});
  EXPECT_EQ(after.rest->positions, positions_of(before));
  EXPECT_EQ(positions_of(after), positions_of(before));
  EXPECT_EQ(after.steps.size(), 1U);
  EXPECT_FALSE(is_moved(after));
  EXPECT_EQ(after.selection.handles[0].vertices, before.selection.handles[0].vertices);
  EXPECT_EQ(edit_region(after).handles[0], before.selection.handles[0].vertices);
  EXPECT_EQ(edit_region(after).belt, after.selection.belt.vertices);
  const AppState chosen = apply(before, Choose{kSecondHandle, box(1.4, 1.6)});
  EXPECT_EQ(chosen.steps.size(), 1U) << "choosing commits first";
  EXPECT_EQ(chosen.selection.handles.size(), 2U);
}

TEST(Command, TheEditHasTheBeltAndTheHeldHolesOfItsStep) {
  Mesh ball;
  const Mesh whole = icosphere(3);
  ball.positions = whole.positions;
  for (Index f = 0; f < whole.face_count(); ++f) {
    if (ball.positions[whole.face(f)[0]].z() > -0.9) ball.add_face(whole.face(f));
  }
  AppState state = apply(open_state(ball), Choose{kRoi, {AllVertices{}}});
  state = apply(state, Choose{kHandle, listed({0, 1, 2, 3})});
  const auto expect_step = [](const AppState& chosen) {
    const EditRegion expected = resolve_edit_region(open_step(chosen), *chosen.rest);
    EXPECT_EQ(edit_region(chosen).belt, expected.belt);
    EXPECT_EQ(edit_region(chosen).held_holes, expected.held_holes);
    return expected.held_holes.size();
  };
  EXPECT_EQ(expect_step(state), 1U);
  Falloff painted;
  painted.field.assign(ball.vertex_count(), 0.0);
  painted.field[1] = 1.0;
  expect_step(apply(state, SetFalloff{0, painted}));
  AppState undone = apply(state, NewEdit{});
  Change(state, undone).undo(undone);
  EXPECT_EQ(expect_step(undone), 1U);
}

TEST(Command, ANewEditKeepsWhatWasDoneAndChoosesNothing) {
  AppState before = apply(settled_tube(), SetBeltWidth{0.2});
  before = apply(before, Settle{handles_alone(before)});
  const AppState after = apply(before, NewEdit{});
  EXPECT_EQ(after.rest->positions, positions_of(before));
  EXPECT_EQ(after.steps.size(), 1U);
  EXPECT_TRUE(after.selection.roi.vertices.empty());
  EXPECT_TRUE(after.selection.handles.empty());
  EXPECT_TRUE(after.moves.empty());
  EXPECT_EQ(after.selection.belt_fraction, 0.2);
  EXPECT_TRUE(same(apply(after, NewEdit{}), after));
  EXPECT_THROW(apply(apply(chosen_tube(), MoveHandle{0, bent()}), NewEdit{}), InputError);
}

TEST(Command, AnROIElsewhereLetsTheHandlesGo) {
  AppState state = apply(settled_tube(), Choose{kRoi, box(0.0, 1.5)});
  EXPECT_TRUE(state.selection.handles.empty());
  EXPECT_TRUE(state.moves.empty());
  EXPECT_EQ(state.steps.size(), 1U) << "what was done stays";
  state = apply(state, Choose{kHandle, box(-0.1, 0.3)});
  EXPECT_EQ(edit_region(state).handles.size(), 1U) << "and the next one needs nothing else";
}

TEST(Command, AnROIThatHoldsSomeOfTheHandlesKeepsThat) {
  AppState state = apply(chosen_tube(), Choose{kSecondHandle, box(1.4, 1.6)});
  const VertexSet head = state.selection.handles[0].vertices;
  state = apply(state, Choose{kRoi, box(2.0, 4.0)});
  ASSERT_EQ(state.selection.handles.size(), 1U);
  EXPECT_EQ(state.selection.handles[0].vertices, head);
  EXPECT_EQ(state.moves.size(), 1U);
  state = apply(state, Choose{kRoi, box(0.3, 2.9)});
  ASSERT_EQ(state.selection.handles.size(), 1U);
  EXPECT_FALSE(state.selection.handles[0].vertices.empty());
  EXPECT_TRUE(subtract(state.selection.handles[0].vertices, state.selection.roi.vertices).empty());
  EXPECT_EQ(edit_region(state).handles.size(), 1U);
}

TEST(Command, AnROIElsewhereLetsABeltChosenByHandGo) {
  AppState state = apply(chosen_tube(), Choose{kBelt, box(0.3, 0.7)});
  state = apply(state, Choose{kRoi, box(1.5, 4.0)});
  EXPECT_TRUE(state.selection.belt_fraction.has_value());
  EXPECT_FALSE(edit_region(state).belt.empty());
}

TEST(Command, WithoutAnROIHandlesWaitForOne) {
  const AppState state = apply(chosen_tube(), Choose{kRoi, listed({})});
  EXPECT_EQ(state.selection.handles.size(), 1U);
  EXPECT_EQ(apply(state, Choose{kRoi, box(0.3, 4.0)}).selection, chosen_tube().selection);
}

TEST(Command, AMirroredROIHoldsTheHandlesOfItsImage) {
  const MirrorPlane plane{{0.0, 0.0, 0.0}, {1.0, 0.0, 0.0}};
  const auto half = [](double from, double to) {
    return RegionSpec{Box{{from, -2.0, 0.3}, {to, 2.0, 4.0}}};
  };
  AppState state = apply(chosen_tube(), SetMirror{plane});
  state = apply(state, Choose{kHandle, {Box{{0.2, -2.0, 2.8}, {2.0, 2.0, 4.0}}}});
  const std::size_t held = state.selection.handles[0].vertices.size();
  state = apply(state, Choose{kRoi, half(-2.0, 0.1)});
  ASSERT_EQ(state.selection.handles.size(), 1U);
  EXPECT_EQ(state.selection.handles[0].vertices.size(), held);
}

TEST(Command, DragMustSettleBeforeSomethingElseIsChosen) {
  const AppState state = apply(chosen_tube(), MoveHandle{0, bent()});
  EXPECT_THROW(apply(state, Choose{kRoi, box(0.0, 4.0)}), InputError);
  EXPECT_THROW(apply(state, Commit{}), InputError);
}

TEST(Command, ALargerRegionKeepsTheMovesAndDiscardsTheResult) {
  const AppState before = settled_tube();
  const VertexSet all = resolve({AllVertices{}}, *before.rest);
  const AppState after = apply(before, EnlargeRoi{subtract(all, before.selection.roi.vertices)});
  EXPECT_EQ(after.selection.roi.vertices, all);
  EXPECT_EQ(after.selection.handles, before.selection.handles);
  EXPECT_EQ(after.moves, before.moves);
  EXPECT_EQ(after.rest, before.rest);
  EXPECT_TRUE(after.steps.empty());
  EXPECT_TRUE(needs_settling(after));
  EXPECT_EQ(apply(before, EnlargeRoi{}).settled, before.settled) << "nothing was added";
}

TEST(Command, WhatDoesNotFitIsRefused) {
  const AppState state = chosen_tube();
  EXPECT_THROW(apply(state, RemoveHandle{1}), InputError);
  EXPECT_THROW(apply(state, MoveHandle{1, bent()}), InputError);
  EXPECT_THROW(apply(state, Choose{{Part::Role::handle, 2}, box(1, 2)}), InputError);
  EXPECT_THROW(apply(state, Settle{handles_alone(state)}), InputError);
  EXPECT_THROW(apply(state, SetBeltWidth{1.5}), InputError);
  EXPECT_THROW(apply(state, Paint{kRoi, {100000}, {}}), InputError);
}

TEST(Command, StepsHaveNames) {
  EXPECT_EQ(describe(Choose{kRoi, box(0, 1)}), "Region: box");
  EXPECT_EQ(describe(Paint{kHandle, {1}, {}}), "Paint handle 1");
  EXPECT_EQ(describe(Paint{kBelt, {}, {1}}), "Erase fixed border");
  EXPECT_EQ(describe(EnlargeRoi{{1}}), "Enlarge region");
  EXPECT_EQ(describe(SetBeltWidth{0.1}), "Fixed border: 10%");
  EXPECT_EQ(describe(MoveHandle{0, twisted(270.0)}), "Move handle 1, rotate 270°");
}

TEST(ToMove, SimilarityKeepsWholeTurns) {
  const Vector3d centroid(1, 2, 3);
  const AngleAxisd turn(500.0 * std::numbers::pi / 180.0, Vector3d(1, 2, 2) / 3.0);
  const Affine3d motion = Eigen::Translation3d(0.5, 0, 0) * Eigen::Translation3d(centroid) * turn *
                          Eigen::Scaling(1.5) * Eigen::Translation3d(-centroid);
  const Move move = to_move(motion, turn, centroid);
  EXPECT_NEAR(turn_of(move).degrees, 500.0, 1e-9);
  EXPECT_LT((to_affine(move, centroid).matrix() - motion.matrix()).norm(), 1e-12);
}

TEST(ToMove, TurnThatIsNotTheMotionsIsNotBelieved) {
  const Affine3d motion(AngleAxisd(1.0, Vector3d::UnitX()));
  const Move move = to_move(motion, AngleAxisd(2.0, Vector3d::UnitX()), Vector3d::Zero());
  EXPECT_NEAR(turn_of(move).degrees, 180.0 / std::numbers::pi, 1e-9);
}

TEST(ToMove, StretchAlongOneAxisIsAMatrix) {
  const Affine3d motion(Eigen::Scaling(1.0, 1.0, 2.0));
  const Move move = to_move(motion, AngleAxisd::Identity(), Vector3d(0, 0, 1));
  EXPECT_EQ(to_affine(move, Vector3d(0, 0, 1)).matrix(), motion.matrix());
  EXPECT_EQ(to_move(Affine3d::Identity(), AngleAxisd::Identity(), Vector3d(1, 2, 3)),
            Move(SimilarityMove{}));
}

}  // namespace
}  // namespace lapwing::viewer::test
