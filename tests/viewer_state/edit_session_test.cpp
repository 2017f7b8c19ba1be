#include "tools/edit_session.h"

#include <chrono>
#include <thread>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "io/temporary_folder.h"
#include "lapwing/base/errors.h"
#include "lapwing/session/run_recipe.h"
#include "viewer_state/tube_edit.h"

namespace lapwing::viewer::test {
namespace {

using lapwing::test::largest_distance;

class ASession : public ::testing::Test {
 protected:
  ASession() {
    write_mesh(bumpy_tube(), mesh_);
    session_.emplace(History(open_state(read_mesh(mesh_))), stamp_of(mesh_), cache_,
                     [] { return std::make_unique<CpuKernels>(); });
    session_->perform(Choose{kRoi, box(0.3, 4.0)});
    session_->perform(Choose{kHandle, box(2.8, 4.0)});
  }
  void drag(const Move& move) {
    session_->perform(MoveHandle{0, move});
    while (!session_->take_result()) std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  Positions positions() const { return positions_of(session_->state()); }
  Positions restored() {
    session_.reset();  // as a crash does, it closes nothing
    const auto edits = find_interrupted(cache_);
    EXPECT_TRUE(edits.at(0).mesh_is_unchanged);
    CpuKernels kernels;
    const History history =
        restore(read_mesh(edits[0].mesh.path), edits[0].draft, solve_with(kernels));
    return positions_of(history.state());
  }

  TemporaryFolder folder_;
  std::filesystem::path mesh_ = folder_ / "tube.obj";
  std::filesystem::path cache_ = folder_ / "cache";
  std::optional<EditSession> session_;
};

TEST_F(ASession, ADragSettlesByItself) {
  drag(bent());
  EXPECT_FALSE(needs_settling(session_->state()));
  EXPECT_GT(largest_distance(positions(), session_->state().rest->positions), 0.3);
}

TEST_F(ASession, NewParametersSettleAnew) {
  drag(twisted(90.0));
  const Positions before = positions();
  session_->perform(SetParameters{{.settle = SettleOptions{.stretch_resistance = 0.5}}});
  while (!session_->take_result()) std::this_thread::sleep_for(std::chrono::milliseconds(1));
  EXPECT_GT(largest_distance(positions(), before), 1e-3);
}

TEST_F(ASession, WhatIsUndoneIsNotSettledAgain) {
  session_->perform(MoveHandle{0, bent()});
  session_->undo();
  std::this_thread::sleep_for(std::chrono::milliseconds(30));
  EXPECT_FALSE(session_->take_result());
  EXPECT_FALSE(is_moved(session_->state()));
}

TEST_F(ASession, RestoredAfterACrashIsWhereItWas) {
  drag(bent());
  drag(twisted(200.0));
  const Positions before = positions();
  EXPECT_LT(largest_distance(restored(), before), 1e-9);
}

TEST_F(ASession, RestoredAfterSavingOverItsMeshStartsFromTheOldOne) {
  drag(bent());
  session_->perform(Commit{});
  session_->save(mesh_);
  drag(twisted(60.0));
  const Positions before = positions();
  EXPECT_LT(largest_distance(restored(), before), 1e-9);
}

TEST_F(ASession, ClosedLeavesNothing) {
  drag(bent());
  session_->save(mesh_);
  session_->close();
  EXPECT_TRUE(std::filesystem::is_empty(cache_));
}

TEST_F(ASession, SavedRecipeGivesTheMesh) {
  drag(bent());
  session_->save_recipe(folder_ / "recipe.json");
  CpuKernels kernels;
  const auto result = run_recipe(read_recipe(folder_ / "recipe.json"), kernels);
  EXPECT_LT(largest_distance(result->mesh.positions, positions()), 1e-9);
  EXPECT_EQ(read_recipe(folder_ / "recipe.json").mesh, "tube.obj");
}

TEST_F(ASession, WithoutAPlaceForItsJournalItGoesOn) {
  EditSession session(History(open_state(bumpy_tube())), stamp_of(mesh_), mesh_ / "inside",
                      [] { return std::make_unique<CpuKernels>(); });
  EXPECT_FALSE(session.warning().empty());
  session.perform(Choose{kRoi, box(0.3, 4.0)});
  EXPECT_EQ(session.history().done(), 1U);
}

TEST_F(ASession, GeneratedMeshHasNoRecipeToSave) {
  EditSession session(History(open_state(bumpy_tube())), {}, cache_,
                      [] { return std::make_unique<CpuKernels>(); });
  EXPECT_THROW(session.save_recipe(folder_ / "recipe.json"), InputError);
  EXPECT_EQ(session.warning(), "");
}

}  // namespace
}  // namespace lapwing::viewer::test
