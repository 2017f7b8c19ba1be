// Steps that are carried out as a whole: undone, redone, recorded and carried out again.
#include "state/whole_step.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "lapwing/base/errors.h"
#include "state/revision.h"
#include "support/error_message.h"
#include "viewer_state/sheet_edit.h"
#include "viewer_state/tube_edit.h"

namespace lapwing::viewer::test {
namespace {

using lapwing::test::largest_distance;
using ::testing::HasSubstr;

class AWholeStep : public ::testing::Test {
 protected:
  AWholeStep() : start_(open_state(read_mesh(files_.sheet()))), history_(start_) {}

  void apply_step(const Step& step) {
    history_.perform(Apply{step, viewer::apply_step(history_.state(), step, {}, kernels_).result});
  }
  void choose_parts() {
    history_.perform(Choose{kRoi, {GeodesicDisk{Index{80}, 0.4}}});
    history_.perform(Choose{kHandle, {GeodesicDisk{Index{80}, 0.1}}});
  }
  CarryOut carry_out() { return carry_out_with(kernels_); }
  // Written for a folder beside those of the meshes, and carried out as `lapwing run` does.
  Mesh run_headless() {
    const auto folder = files_.folder() / "recipes";
    const Recipe recipe = to_recipe(history_.state(), "../targets/sheet.ply", folder);
    std::filesystem::create_directories(folder);
    return run_recipe(parse_recipe(to_json(recipe), folder, "test"), kernels_)->mesh;
  }

  SheetAndRelief files_;
  CpuKernels kernels_;
  AppState start_;
  History history_;
};

TEST_F(AWholeStep, MovesTheVerticesOfItsPatchAndKeepsWhatIsChosen) {
  choose_parts();
  apply_step(files_.coat());
  const AppState& state = history_.state();
  EXPECT_TRUE(state.rest->shares_faces_with(*start_.rest));
  EXPECT_GT(largest_distance(positions_of(state), start_.rest->positions), 1e-3);
  EXPECT_FALSE(state.selection.roi.vertices.empty());
  EXPECT_EQ(state.selection.handles.size(), 1U);
  EXPECT_TRUE(history_.unsaved());
}

TEST_F(AWholeStep, WithOtherTrianglesIsUndoneToTheVeryMesh) {
  choose_parts();
  const AppState before = history_.state();
  apply_step(files_.coat(1.0, Remeshing::automatic));
  const AppState after = history_.state();
  ASSERT_GT(after.rest->vertex_count(), before.rest->vertex_count());
  EXPECT_TRUE(after.selection.roi.vertices.empty()) << "numbers mean other vertices now";
  EXPECT_TRUE(after.selection.handles.empty());

  history_.undo();
  EXPECT_EQ(history_.state().rest, before.rest) << "not a copy: nothing of it can be lost";
  EXPECT_TRUE(history_.state().rest->shares_faces_with(*before.rest));
  EXPECT_TRUE(same(history_.state(), before));
  history_.redo();
  EXPECT_EQ(history_.state().rest, after.rest);
  EXPECT_TRUE(same(history_.state(), after));
}

TEST_F(AWholeStep, StandsBetweenEdits) {
  perform(history_, SheetAndRelief::lift(), carry_out().solve);
  apply_step(files_.coat(1.0, Remeshing::automatic));
  perform(history_, SheetAndRelief::lift(), carry_out().solve);
  ASSERT_EQ(history_.state().steps.size(), 2U) << "and the second lift open";
  EXPECT_TRUE(same_mesh(run_headless(), mesh_of(history_.state())));
  while (history_.can_undo()) history_.undo();
  EXPECT_EQ(positions_of(history_.state()), start_.rest->positions);
}

TEST_F(AWholeStep, OfAnOpenedRecipeIsOneStepOfTheHistory) {
  apply_step(files_.coat(1.0, Remeshing::automatic));
  const auto folder = files_.folder() / "recipes";
  const Recipe recipe = to_recipe(history_.state(), "../targets/sheet.ply", folder);
  EXPECT_EQ(std::get<CoatStep>(recipe.steps.at(0)).source.mesh, "../sources/relief.ply");
  const History opened = from_recipe(start_, recipe, carry_out());
  EXPECT_EQ(opened.names(), std::vector<std::string>{"Coat from relief.ply"});
  EXPECT_TRUE(same(opened.state(), history_.state()));
}

TEST_F(AWholeStep, MayBeAWrapOntoAScanOfAnOpenedRecipe) {
  Mesh scan = *start_.rest;
  for (Eigen::Vector3d& p : scan.positions) p.z() += 0.1 * p.x();
  write_mesh(scan, files_.folder() / "scan.ply");
  const auto folder = files_.folder() / "recipes";
  const std::string text = R"({"lapwing": 1, "mesh": "../targets/sheet.ply", "steps": [
    {"op": "wrap", "scan": "../scan.ply", "aligned": true,
     "landmarks": [{"vertex": 3, "scan_vertex": 3}]}]})";
  history_ = from_recipe(start_, parse_recipe(text, folder, "test"), carry_out());
  EXPECT_EQ(history_.names(), std::vector<std::string>{"Wrap onto scan.ply"});
  EXPECT_LT(largest_distance(positions_of(history_.state()), scan.positions), 0.05);
  EXPECT_TRUE(same_mesh(run_headless(), mesh_of(history_.state())));
}

TEST_F(AWholeStep, WaitsForTheResultOfADrag) {
  choose_parts();
  history_.perform(MoveHandle{0, bent()});
  EXPECT_THAT(error_message<InputError>([&] { apply_step(files_.coat()); }),
              HasSubstr("not refined yet"));
}

TEST_F(AWholeStep, WithoutAResultOrWithOneOfAnotherMeshIsRefused) {
  EXPECT_THROW(history_.perform(Apply{files_.coat(), nullptr}), InputError);
  const AppliedStep other = MovedVertices{{5000}, {Eigen::Vector3d::Zero()}};
  EXPECT_THROW(history_.perform(Apply{files_.coat(), std::make_shared<const AppliedStep>(other)}),
               InputError);
  EXPECT_EQ(history_.size(), 0U);
}

TEST_F(AWholeStep, NamesItsSourceByAnAbsolutePathAndFromTheRecipesFolder) {
  CoatStep step = files_.coat();
  step.source.mesh = "../sources/relief.ply";
  const Step absolute = with_absolute_paths(step, files_.folder() / "targets");
  EXPECT_EQ(std::get<CoatStep>(absolute).source.mesh, files_.relief());
  EXPECT_EQ(with_paths_from(absolute, files_.folder() / "targets"), Step(step));
  step.source.mesh.clear();
  EXPECT_EQ(with_absolute_paths(step, files_.folder()), Step(step)) << "the mesh itself";
}

class ARevision : public AWholeStep {
 protected:
  ARevision() {
    apply_step(files_.coat(1.0));
    perform(history_, SheetAndRelief::lift(), carry_out().solve);
    apply_step(files_.coat(0.5));
  }
  void revise(std::size_t index, const Step& step) {
    const Revision revision = revision_of(history_, index, step);
    history_.perform(
        Revise{step, std::make_shared<const AppState>(revised(revision, carry_out()))});
  }
};

TEST_F(ARevision, CarriesOutWhatFollowsItAndIsOneStepToUndo) {
  const AppState before = history_.state();
  revise(0, files_.coat(2.0));
  EXPECT_GT(largest_distance(positions_of(history_.state()), positions_of(before)), 1e-3);
  EXPECT_EQ(*history_.state().steps.at(0), Step(files_.coat(2.0)));
  EXPECT_EQ(*history_.state().steps.at(2), Step(files_.coat(0.5)));
  EXPECT_TRUE(same_mesh(run_headless(), mesh_of(history_.state())));
  history_.undo();
  EXPECT_TRUE(same(history_.state(), before));
  history_.redo();
  EXPECT_TRUE(same_mesh(run_headless(), mesh_of(history_.state())));
}

TEST_F(ARevision, StartsWhereItsStepDid) {
  history_.perform(Choose{kRoi, {GeodesicDisk{Index{80}, 0.2}}});
  for (std::size_t index = 0; index < 3; ++index) {
    const Revision revision = revision_of(history_, index, SheetAndRelief::lift());
    EXPECT_TRUE(revision.starts_at_step()) << index;
    EXPECT_EQ(revision.start.steps.size(), index);
    EXPECT_FALSE(is_moved(revision.start)) << "what was open is committed";
  }
}

TEST_F(ARevision, OfARevisedHistoryStartsFromTheStepsThatAreThere) {
  revise(0, files_.coat(2.0));
  revise(2, files_.coat(1.5));
  EXPECT_EQ(*history_.state().steps.at(0), Step(files_.coat(2.0)));
  EXPECT_TRUE(same_mesh(run_headless(), mesh_of(history_.state())));
}

TEST_F(ARevision, ThatChangesTheTrianglesLetsGoOfWhatIsChosen) {
  history_.perform(Choose{kRoi, {GeodesicDisk{Index{80}, 0.2}}});
  revise(2, files_.coat(0.5));
  EXPECT_FALSE(history_.state().selection.roi.vertices.empty());
  revise(2, files_.coat(0.5, Remeshing::automatic));
  EXPECT_TRUE(history_.state().selection.roi.vertices.empty());
  EXPECT_TRUE(same_mesh(run_headless(), mesh_of(history_.state())));
}

TEST_F(ARevision, OfADeformOrTheOpenOneIsADeformAgain) {
  DeformRequest higher = SheetAndRelief::lift();
  std::get<SimilarityMove>(higher.handles[0].move).translate.z() = 0.2;
  revise(1, higher);
  EXPECT_TRUE(same_mesh(run_headless(), mesh_of(history_.state())));
  perform(history_, SheetAndRelief::lift(), carry_out().solve);
  revise(3, higher);
  EXPECT_EQ(open_step(history_.state()).handles, higher.handles);
  EXPECT_TRUE(same_mesh(run_headless(), mesh_of(history_.state())));
  EXPECT_THROW(revision_of(history_, 3, files_.coat()), InputError);
  EXPECT_THROW(revision_of(history_, 4, higher), InputError);
}

}  // namespace
}  // namespace lapwing::viewer::test
