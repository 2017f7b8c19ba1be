// Files that follow the surface in the viewer: undone, redone, restored, replayed and saved.
#include <fstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "io/temporary_folder.h"
#include "lapwing/base/errors.h"
#include "lapwing/io/mesh_file.h"
#include "lapwing/io/point_table.h"
#include "lapwing/mesh/shapes.h"
#include "lapwing/mesh/transform.h"
#include "lapwing/run/run_recipe.h"
#include "support/error_message.h"
#include "support/split_meshes.h"
#include "viewer_state/tube_edit.h"
#include "work/crash_recovery.h"
#include "work/edit_session.h"

namespace lapwing::viewer::test {
namespace {

namespace fs = std::filesystem;
using Eigen::Vector3d;
using lapwing::test::largest_distance;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

class CarriedInAWindow : public ::testing::Test {
 protected:
  CarriedInAWindow() {
    Mesh hat = icosphere(2);
    transform(hat, Eigen::Translation3d(0.0, 0.0, 3.1) * Eigen::Scaling(0.3));
    write_mesh(hat, hat_);
    std::ofstream(points_) << "x,y,z,nx,ny,nz\n0.9,0,2.5,1,0,0\n0,0.9,1.5,0,1,0\n";
    open(bumpy_tube());
  }

  void open(const Mesh& mesh) {
    write_mesh(mesh, tube_);
    session_.emplace(History(open_state(read_mesh(tube_))), stamp_of(tube_), folder_ / "cache",
                     cpu_kernels);
    session_->perform(Choose{kRoi, box(0.3, 4.0)});
    session_->perform(Choose{kHandle, box(2.8, 4.0)});
  }
  void carry(const std::vector<fs::path>& files) {
    session_->carry_along(files);
    wait_until([&] { return session_->take_step().has_value(); });
    if (needs_settling(state())) wait_for_result();
  }
  void wait_for_result() {
    test::wait_until([&] { return session_->take_result(); });
  }
  void drag(const Move& move) {
    session_->perform(MoveHandle{0, move});
    wait_for_result();
  }
  const AppState& state() const { return session_->state(); }
  Positions places(std::size_t object = 0) const {
    return carried_of(state()).at(object)->positions();
  }
  std::unique_ptr<RunResult> run_headless() {
    session_->save_recipe(folder_ / "recipe.json");
    return run_recipe(read_recipe(folder_ / "recipe.json"), kernels_);
  }
  void expect_same_as(const RunResult& run) const {
    const CarriedFiles carried = carried_of(state());
    ASSERT_EQ(carried.size(), run.carried.size());
    for (std::size_t k = 0; k < carried.size(); ++k) {
      EXPECT_EQ(carried[k]->file(), run.carried[k].file());
      EXPECT_LT(largest_distance(carried[k]->positions(), run.carried[k].positions()), 1e-9);
    }
    EXPECT_LT(largest_distance(positions_of(state()), run.mesh.positions), 1e-9);
  }

  TemporaryFolder folder_;
  fs::path tube_ = folder_ / "tube.obj";
  fs::path hat_ = folder_ / "hat.obj";
  fs::path points_ = folder_ / "points.csv";
  CpuKernels kernels_;
  std::optional<EditSession> session_;
};

TEST_F(CarriedInAWindow, FollowsADragAndIsUndoneAndRedoneWithIt) {
  carry({"hat.obj"});
  const Positions opened = places();
  EXPECT_EQ(opened, read_mesh(hat_).positions);
  drag(bent());
  const Positions bent_there = places();
  EXPECT_GT(largest_distance(bent_there, opened), 0.3);
  drag(twisted(60.0));
  EXPECT_GT(largest_distance(places(), bent_there), 0.1);
  session_->undo();
  EXPECT_EQ(places(), bent_there);
  session_->undo();
  EXPECT_EQ(places(), opened);
  session_->undo();
  EXPECT_TRUE(state().carried.empty());
  session_->go_to(4);
  EXPECT_EQ(places(), bent_there);
  EXPECT_THAT(session_->history().names(),
              ElementsAre("Region: box", "Handle 1: box", "Attach hat.obj",
                          HasSubstr("Move handle 1"), HasSubstr("Move handle 1")));
}

TEST_F(CarriedInAWindow, StepsGoOnFromWhereTheOneBeforeLeftItAsInARun) {
  carry({"hat.obj", "points.csv"});
  drag(bent());
  session_->perform(Choose{kHandle, box(2.7, 4.0)});
  ASSERT_EQ(state().steps.size(), 1U);
  const Positions after_first = places();
  drag(twisted(40.0));
  EXPECT_GT(largest_distance(places(), after_first), 0.05);
  const auto run = run_headless();
  expect_same_as(*run);

  const History opened = from_recipe(
      open_state(read_mesh(tube_)), read_recipe(folder_ / "recipe.json"), carry_out_with(kernels_));
  EXPECT_LT(largest_distance(carried_of(opened.state())[0]->positions(), places(0)), 1e-9);
  EXPECT_LT(largest_distance(carried_of(opened.state())[1]->positions(), places(1)), 1e-9);
  EXPECT_EQ(draft_of(opened.state()), draft_of(state()));
}

TEST_F(CarriedInAWindow, OfAScaledATurnedFarAndAMirroredEditIsWhatARunMakesOfIt) {
  carry({"hat.obj", "points.csv"});
  SimilarityMove grown = std::get<SimilarityMove>(bent());
  grown.scale.setConstant(1.6);
  drag(grown);
  expect_same_as(*run_headless());
  EditParameters in_parts;
  in_parts.commit_every = 60.0;
  session_->perform(SetParameters{in_parts});
  wait_for_result();
  drag(twisted(150.0));
  expect_same_as(*run_headless());
  session_->perform(SetParameters{});
  wait_for_result();
  session_->perform(SetMirror{MirrorPlane{{0.0, 0.0, 0.0}, {1.0, 0.0, 0.0}}});
  wait_until([&] { return session_->take_result() || !needs_settling(state()); });
  expect_same_as(*run_headless());
}

TEST_F(CarriedInAWindow, OverASurfaceWithSeamsIsWhatARunMakesOfIt) {
  open(lapwing::test::soup(bumpy_tube()).mesh);
  carry({"hat.obj", "points.csv"});
  ASSERT_NE(joined_seams(state()), nullptr);
  drag(bent());
  EXPECT_GT(largest_distance(places(), read_mesh(hat_).positions), 0.3);
  expect_same_as(*run_headless());
}

TEST_F(CarriedInAWindow, AddedAfterADragFollowsThatDrag) {
  drag(bent());
  carry({"hat.obj"});
  EXPECT_GT(largest_distance(places(), read_mesh(hat_).positions), 0.3);
  expect_same_as(*run_headless());
}

TEST_F(CarriedInAWindow, TakenOffTheListStaysWhereStepsHaveTakenIt) {
  carry({"hat.obj", "points.csv"});
  session_->perform(StopCarrying{points_});
  EXPECT_EQ(state().carried.size(), 1U) << "no step knows of it";
  drag(bent());
  session_->perform(Commit{});
  const Positions left = places();
  session_->perform(StopCarrying{hat_});
  ASSERT_EQ(state().carried.size(), 1U) << "a run would save it";
  drag(twisted(40.0));
  EXPECT_EQ(places(), left);
  expect_same_as(*run_headless());
  session_->perform(CarryAlong{open_carried(hat_)});
  wait_for_result();
  EXPECT_GT(largest_distance(places(), left), 0.05);
  expect_same_as(*run_headless());
}

TEST_F(CarriedInAWindow, IsRestoredAfterACrash) {
  carry({"hat.obj"});
  drag(bent());
  session_->perform(Commit{});
  drag(twisted(20.0));
  const Positions before = places();
  session_.reset();
  const auto edits = find_interrupted(folder_ / "cache");
  ASSERT_EQ(edits.size(), 1U);
  const History history = restore_after_crash(open_state(read_mesh(tube_)), edits[0], kernels_);
  EXPECT_LT(largest_distance(carried_of(history.state()).at(0)->positions(), before), 1e-9);
}

TEST_F(CarriedInAWindow, IsSavedBesideTheMeshAsARunSavesIt) {
  carry({"hat.obj", "points.csv"});
  drag(bent());
  for (const char* name : {"out", "run", "alone"}) fs::create_directories(folder_ / name);
  session_->save(folder_ / "out" / "bent.obj");
  const auto run = run_headless();
  save_result(*run, folder_ / "run" / "bent.obj");
  const auto read = [&](const fs::path& path) {
    return path.extension() == ".csv" ? read_point_table(path).positions
                                      : read_mesh(path).positions;
  };
  for (const char* name : {"bent.obj", "hat-carried.obj", "points-carried.csv"}) {
    EXPECT_LT(largest_distance(read(folder_ / "out" / name), read(folder_ / "run" / name)), 1e-9);
  }
  session_->save_carried(folder_ / "alone" / "bent.obj");
  EXPECT_TRUE(fs::exists(folder_ / "alone" / "hat-carried.obj"));
  EXPECT_FALSE(fs::exists(folder_ / "alone" / "bent.obj"));
}

TEST_F(CarriedInAWindow, SavesNothingOverWhatWasRead) {
  session_->perform(CarryAlong{open_carried(hat_, tube_)});
  EXPECT_THAT(error_message<InputError>([&] { session_->save(folder_ / "bent.obj"); }),
              HasSubstr("hat.obj: it would be saved as " + tube_.string()));
  EXPECT_FALSE(fs::exists(folder_ / "bent.obj"));
}

TEST_F(CarriedInAWindow, AFileThatCannotBeCarriedIsNamedWithTheReason) {
  std::ofstream(folder_ / "empty.obj") << "# nothing\n";
  std::ofstream(folder_ / "no-points.csv") << "x,y,z\n";
  std::ofstream(folder_ / "broken.obj") << "v 0 0 0\nv nan 0 0\n";
  const auto refused = [&](const char* file) -> std::string {
    session_->carry_along({file});
    try {
      wait_until([&] { return session_->take_step().has_value(); });
    } catch (const Error& error) {
      return error.what();
    }
    return "";
  };
  EXPECT_THAT(refused("none.obj"), HasSubstr("none.obj"));
  EXPECT_THAT(refused("empty.obj"), HasSubstr("empty.obj: it has no vertices to carry"));
  EXPECT_THAT(refused("no-points.csv"), HasSubstr("no-points.csv"));
  EXPECT_THAT(refused("broken.obj"), HasSubstr("broken.obj"));
  EXPECT_TRUE(state().carried.empty());
  EXPECT_THAT(error_message<InputError>([&] { session_->perform(StopCarrying{hat_}); }),
              HasSubstr("hat.obj is not attached"));
}

TEST_F(CarriedInAWindow, AResultThatLacksItIsRefused) {
  carry({"hat.obj"});
  AppState moved = apply(state(), MoveHandle{0, bent()});
  EXPECT_THROW(apply(moved, Settle{handles_alone(moved)}), InputError);
}

TEST_F(CarriedInAWindow, OfARecipeWithTargetsGoesOnByHand) {
  const Recipe recipe = parse_recipe(R"({"lapwing": 1, "mesh": "tube.obj", "steps": [
      {"op": "deform", "roi": {"all": true}, "belt": {"vertices": [0, 4, 8, 15]},
       "targets": {"rows": [[100, 0.9, 0.1, 1.5]]}, "carry": ["hat.obj"]},
      {"op": "deform", "roi": {"all": true}, "belt": {"vertices": [0, 4, 8, 15]},
       "handles": [{"region": {"vertices": [100]}, "move": {"translate": [0.1, 0, 0]}}],
       "carry": ["hat.obj", {"file": "points.csv", "save": "moved.csv"}]}]})",
                                     folder_.path(), "test");
  const History history =
      from_recipe(open_state(read_mesh(tube_)), recipe, carry_out_with(kernels_));
  const auto run = run_recipe(recipe, kernels_);
  const CarriedFiles carried = carried_of(history.state());
  ASSERT_EQ(carried.size(), 2U);
  for (std::size_t k = 0; k < 2; ++k) {
    EXPECT_LT(largest_distance(carried[k]->positions(), run->carried[k].positions()), 1e-9);
  }
  EXPECT_EQ(carried[1]->save, folder_ / "moved.csv");
  EXPECT_EQ(to_recipe(history.state(), "tube.obj", folder_.path()).steps, recipe.steps);
}

}  // namespace
}  // namespace lapwing::viewer::test
