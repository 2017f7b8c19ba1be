#include "state/draft.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "io/temporary_folder.h"
#include "lapwing/base/errors.h"
#include "lapwing/deform/deform_solver.h"
#include "lapwing/io/mesh_file.h"
#include "lapwing/run/run_recipe.h"
#include "state/waypoints.h"
#include "support/error_message.h"
#include "viewer_state/tube_edit.h"

namespace lapwing::viewer::test {
namespace {

using lapwing::test::largest_distance;

class AnEdit : public ::testing::Test {
 protected:
  AnEdit() {
    write_mesh(bumpy_tube(), folder_ / "tube.obj");
    mesh_ = read_mesh(folder_ / "tube.obj");
  }

  // As the viewer does: a DeformSolver prepared once, solved for the state's motions.
  void settle(History& history) {
    const AppState& state = history.state();
    if (uses_substeps(state.parameters, state.moves)) {
      history.perform(Settle{solve_open_step(state, kernels_)});
      return;
    }
    const DeformSolver deformer(state.rest->positions, state.rest->topology(), edit_region(state),
                                state.parameters, kernels_);
    const auto result = deformer.solve_along(path_of(state), motions_of(state));
    history.perform(Settle{std::make_shared<const MovedVertices>(
        moved_vertices(state.rest->positions, result.positions))});
  }

  // Two edits with a painted ROI, a disk, a full turn and a second,
  // graded handle.
  History edited() {
    History history(open_state(mesh_));
    history.perform(Choose{kRoi, box(0.3, 4.0)});
    history.perform(Paint{kRoi, {}, {30, 31}});
    history.perform(Choose{kHandle, box(2.8, 4.0)});
    history.perform(MoveHandle{0, twisted(100.0)});
    settle(history);
    history.perform(MoveHandle{0, twisted(200.0)});
    settle(history);
    history.perform(Choose{kRoi, {AllVertices{}}});
    history.perform(Choose{kSecondHandle, {GeodesicDisk{Index{125}, 0.4}}});
    history.perform(Choose{kBelt, box(-1.0, 0.4)});
    history.perform(SetFalloff{1, {.weight = 2.0, .transition = Transition{0.3}}});
    history.perform(SetParameters{{{.weights = LaplacianWeights::cotangent, .hard = true}}});
    history.perform(MoveHandle{1, bent()});
    settle(history);
    return history;
  }

  Recipe recipe_of(const History& history) const {
    return to_recipe(history.state(), "tube.obj", folder_.path());
  }
  History restored(const AppState& state) {
    return from_draft(open_state(mesh_), draft_of(state), carry_out_with(kernels_));
  }
  Positions replayed(const Recipe& recipe) {
    return run_recipe(parse_recipe(to_json(recipe), folder_.path(), "test"), kernels_)
        ->mesh.positions;
  }

  TemporaryFolder folder_;
  Mesh mesh_;
  CpuKernels kernels_;
};

TEST_F(AnEdit, OfARecipeWithTargetsIsAStepOfItsOwn) {
  const Recipe recipe = parse_recipe(R"({"lapwing": 1, "mesh": "tube.obj", "steps": [
      {"op": "deform", "roi": {"all": true}, "belt": {"vertices": [0, 4, 8, 15]},
       "targets": {"rows": [[100, 0.9, 0.1, 1.5]], "hard": true}}]})",
                                     folder_.path(), "test");
  const History history = from_recipe(open_state(mesh_), recipe, carry_out_with(kernels_, {}));
  EXPECT_EQ(positions_of(history.state())[100], Eigen::Vector3d(0.9, 0.1, 1.5));
  const Recipe again = recipe_of(history);
  EXPECT_EQ(again.steps, recipe.steps);
  EXPECT_EQ(replayed(again), positions_of(history.state()));
}

TEST_F(AnEdit, OfARecipeWithAMirrorOrAFalloffGoesOnByHand) {
  for (const std::string keys :
       {R"("mirror": "auto", "handles": [{)", R"("handles": [{"falloff": {"width": 1}, )"}) {
    const Recipe recipe = parse_recipe(
        R"({"lapwing": 1, "mesh": "tube.obj", "steps": [
      {"op": "deform", "roi": {"all": true}, "belt": {"vertices": [0, 4, 8, 15]}, )" +
            keys + R"("region": {"vertices": [100]}, "move": {"translate": [0, 0, 0.2]}}]}]})",
        folder_.path(), "test");
    const History history = from_recipe(open_state(mesh_), recipe, carry_out_with(kernels_, {}));
    EXPECT_EQ(history.state().steps.size(), 0U) << "still open";
    const Positions positions = positions_of(history.state());
    EXPECT_EQ(replayed(recipe), positions) << keys;
    EXPECT_EQ(replayed(recipe_of(history)), positions) << "with the plane that was found";
  }
}

TEST_F(AnEdit, WithAMirrorIsReplayedRestoredAndUndone) {
  Index side = 0;
  for (Index v = 0; v < mesh_.vertex_count(); ++v) {
    const Eigen::Vector3d& p = mesh_.positions[v];
    if (std::abs(p.z() - 2.0) < 0.2 && p.x() > mesh_.positions[side].x()) side = v;
  }
  History history(open_state(mesh_));
  history.perform(Choose{kRoi, box(0.3, 4.0)});
  history.perform(Choose{kHandle, {GeodesicDisk{side, 0.2}}});
  history.perform(SetMirror{MirrorPlane{{0.0, 0.0, 0.0}, {1.0, 0.0, 0.0}}});
  ASSERT_NE(history.state().mirrored, nullptr);
  EXPECT_EQ(edit_region(history.state()).handles.size(), 2U);
  history.perform(MoveHandle{0, bent()});
  EXPECT_EQ(motions_of(history.state()).maps.size(), 2U);
  std::vector<std::size_t> dragged;
  dragged_handles(history.state(), 0, false, dragged);
  EXPECT_EQ(dragged, (std::vector<std::size_t>{0, 1})) << "with its image";
  settle(history);
  const AppState state = history.state();
  EXPECT_LT(largest_distance(replayed(recipe_of(history)), positions_of(state)), 1e-9);
  const AppState again = restored(state).state();
  EXPECT_EQ(draft_of(again), draft_of(state));
  EXPECT_LT(largest_distance(positions_of(again), positions_of(state)), 1e-9);

  history.perform(SetMirror{});
  EXPECT_EQ(history.state().mirrored, nullptr);
  EXPECT_TRUE(needs_settling(history.state()));
  history.undo();
  EXPECT_EQ(history.state().mirrored, state.mirrored);
  EXPECT_THROW(history.perform(SetMirror{MirrorPlane{{9.0, 0.0, 0.0}, {1.0, 0.0, 0.0}}}),
               InputError)
      << "a plane that misses the mesh";
  // Where the image is in the way of another handle nothing is prepared, and whoever does says why.
  const AppState both = apply(state, Choose{kSecondHandle, {AllVertices{}}});
  EXPECT_EQ(both.mirrored, nullptr);
  EXPECT_THROW(edit_region(both), InputError);
}

TEST_F(AnEdit, RecipeFollowsUndo) {
  History history = edited();
  ASSERT_EQ(recipe_of(history).steps.size(), 2U);
  for (; history.can_undo(); history.undo()) {
    if (needs_settling(history.state())) continue;
    ASSERT_LT(largest_distance(replayed(recipe_of(history)), positions_of(history.state())), 1e-9)
        << "after " << history.done() << " steps";
  }
}

TEST_F(AnEdit, RestoredFromItsDraftIsTheSameState) {
  const AppState state = edited().state();
  const History again = restored(state);
  EXPECT_EQ(draft_of(again.state()), draft_of(state));
  EXPECT_LT(largest_distance(positions_of(again.state()), positions_of(state)), 1e-9);
  EXPECT_TRUE(again.can_undo());
}

TEST_F(AnEdit, HalfChosenIsRestoredAsItStands) {
  History history(open_state(mesh_));
  history.perform(Paint{kRoi, {5, 6, 7}, {}});
  history.perform(SetBeltWidth{0.25});
  EXPECT_EQ(draft_of(restored(history.state()).state()), draft_of(history.state()));
}

TEST_F(AnEdit, UnsettledDragIsRestoredUnsettled) {
  History history(open_state(mesh_));
  history.perform(Choose{kRoi, box(0.3, 4.0)});
  history.perform(Choose{kHandle, box(2.8, 4.0)});
  history.perform(MoveHandle{0, bent()});
  const AppState again = restored(history.state()).state();
  EXPECT_TRUE(needs_settling(again));
  EXPECT_TRUE(same(again, history.state()));
}

TEST_F(AnEdit, OpenedRecipeCanBeUndoneStepByStep) {
  const History history = edited();
  History opened = from_recipe(open_state(mesh_), recipe_of(history), carry_out_with(kernels_));
  EXPECT_LT(largest_distance(positions_of(opened.state()), positions_of(history.state())), 1e-9);
  opened.go_to(0);
  EXPECT_EQ(positions_of(opened.state()), mesh_.positions);
}

TEST_F(AnEdit, RecipeIsReplayedOnAnotherMesh) {
  History history(open_state(mesh_));
  history.perform(Choose{kRoi, box(0.3, 4.0)});
  history.perform(Choose{kHandle, box(2.8, 4.0)});
  history.perform(MoveHandle{0, bent()});
  settle(history);
  const History other = from_recipe(open_state(cylinder(20, 30, 0.5, 3.0)), recipe_of(history),
                                    carry_out_with(kernels_));
  EXPECT_GT(largest_distance(positions_of(other.state()), other.state().rest->positions), 0.3);
}

TEST_F(AnEdit, WithHandlesThatLostTheirVerticesIsRestoredAsItStands) {
  History history(open_state(mesh_));
  history.perform(Choose{kRoi, box(0.3, 4.0)});
  const auto choose = [&](std::size_t handle, std::vector<Index> vertices) {
    history.perform(Choose{{Part::Role::handle, handle}, {ListedVertices{std::move(vertices)}}});
  };
  choose(0, {100, 101});
  choose(1, {110, 111});
  choose(0, {});
  const Draft draft = draft_of(history.state());
  EXPECT_EQ(draft.open.handles.size(), 2U);
  EXPECT_EQ(draft_of(restored(history.state()).state()), draft);
}

}  // namespace
}  // namespace lapwing::viewer::test
