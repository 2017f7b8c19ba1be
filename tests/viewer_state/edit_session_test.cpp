#include "work/edit_session.h"

#include <chrono>
#include <thread>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "io/temporary_folder.h"
#include "lapwing/base/errors.h"
#include "lapwing/run/run_recipe.h"
#include "viewer_state/tube_edit.h"
#include "work/certificate_words.h"
#include "work/crash_recovery.h"

namespace lapwing::viewer::test {
namespace {

using lapwing::test::largest_distance;
using ::testing::ElementsAre;

class ASession : public ::testing::Test {
 protected:
  ASession() {
    write_mesh(bumpy_tube(), mesh_);
    session_.emplace(History(open_state(read_mesh(mesh_))), stamp_of(mesh_), cache_, cpu_kernels);
    session_->perform(Choose{kRoi, box(0.3, 4.0)});
    session_->perform(Choose{kHandle, box(2.8, 4.0)});
  }
  void drag(const Move& move) {
    session_->perform(MoveHandle{0, move});
    wait_for_result();
  }
  void wait_for_result() {
    wait_until([&] { return session_->take_result(); });
  }
  void wait_for(PreparationStatus::Phase phase) {
    wait_until([&] { return session_->preparation().status().phase == phase; });
  }
  // Where a drag to `moves` comes to rest.
  Positions follow_to_the_end(const std::vector<HandleMove>& moves,
                              std::shared_ptr<const DragState> from) {
    for (;;) {
      wait_for(PreparationStatus::Phase::ready);
      session_->settle_live(moves, from);
      wait_for(PreparationStatus::Phase::ready);
      const LiveResult result = session_->take_live_result().value();
      from = result.pose;
      if (result.is_done) return positions_at(session_->state(), *from);
    }
  }
  // A crash, which closes nothing; the next start restores the edit and discards the old journal.
  InterruptedEdit crash_and_restore() {
    session_.reset();
    const auto edits = find_interrupted(cache_);
    EXPECT_EQ(edits.size(), 1U);
    CpuKernels kernels;
    session_.emplace(
        restore_after_crash(open_state(read_mesh(edits[0].mesh.path)), edits[0], kernels),
        std::nullopt, cache_, cpu_kernels, nullptr, nullptr, &edits[0]);
    discard(edits[0]);
    return edits[0];
  }
  // Of the session, which runs.
  std::filesystem::path journal() const {
    for (const auto& entry : std::filesystem::directory_iterator(cache_)) {
      if (entry.path().extension() == ".journal") return entry.path();
    }
    return {};
  }
  Positions positions() const { return positions_of(session_->state()); }

  TemporaryFolder folder_;
  std::filesystem::path mesh_ = folder_ / "tube.obj";
  std::filesystem::path cache_ = folder_ / "cache";
  std::optional<EditSession> session_;
};

TEST_F(ASession, NewParametersSettleAnew) {
  drag(twisted(90.0));
  const Positions before = positions();
  session_->perform(SetParameters{{{.detail_length = 0.5}}});
  wait_for_result();
  EXPECT_GT(largest_distance(positions(), before), 1e-3);
}

TEST_F(ASession, WhatIsUndoneIsNotSettledAgain) {
  session_->perform(MoveHandle{0, bent()});
  session_->undo();
  std::this_thread::sleep_for(std::chrono::milliseconds(30));
  EXPECT_FALSE(session_->take_result());
  EXPECT_FALSE(is_moved(session_->state()));
}

TEST_F(ASession, WhatUndoAndRedoLeaveUnsettledSettlesByItself) {
  session_->perform(MoveHandle{0, bent()});
  session_->perform(MoveHandle{0, twisted(60.0)});
  wait_for_result();
  session_->undo();
  EXPECT_TRUE(session_->awaits_result());
  wait_for_result();
  EXPECT_EQ(session_->state().moves[0].move, bent());
  session_->undo();
  session_->redo();
  EXPECT_FALSE(needs_settling(session_->state()));
  session_->redo();
  EXPECT_FALSE(needs_settling(session_->state()));
  EXPECT_EQ(session_->state().moves[0].move, twisted(60.0));
}

TEST_F(ASession, ASavedRecipeThatFollowsAPathIsRunToSeeThatItEndsInTheSameSurface) {
  drag(twisted(70.0));
  session_->save_recipe(folder_ / "near.json");
  EXPECT_EQ(session_->take_recipe_check(), std::nullopt) << "without a path there is one result";
  drag(twisted(140.0));
  ASSERT_FALSE(session_->state().moves[0].path.empty());
  session_->save_recipe(folder_ / "far.json");
  EXPECT_LT(awaited([&] { return session_->take_recipe_check(); }), 1e-3);
  EXPECT_EQ(read_recipe(folder_ / "far.json").mesh, "tube.obj");
}

TEST_F(ASession, HalfAStepIsNeverSaved) {
  const Positions opened = read_mesh(mesh_).positions;
  session_->perform(MoveHandle{0, bent()});
  EXPECT_TRUE(session_->awaits_result());
  EXPECT_THROW(session_->save(mesh_), InputError);
  EXPECT_THROW(session_->save_recipe(folder_ / "recipe.json"), InputError);
  EXPECT_THROW(session_->save_carried(mesh_), InputError);
  EXPECT_EQ(read_mesh(mesh_).positions, opened);
  EXPECT_FALSE(std::filesystem::exists(folder_ / "recipe.json"));
  session_->cancel_settling();
  EXPECT_FALSE(session_->awaits_result()) << "given up";
  session_->prepare();
  wait_for_result();
  session_->save(mesh_);
  EXPECT_LT(largest_distance(read_mesh(mesh_).positions, positions()), 1e-6);
}

TEST_F(ASession, EitherWeightsSettleWithoutAFalseAlarm) {
  for (const LaplacianWeights weights : {LaplacianWeights::uniform, LaplacianWeights::cotangent}) {
    session_->perform(SetParameters{{{.weights = weights}}});
    if (needs_settling(session_->state())) wait_for_result();
    drag(bent());
    const Certificate& certificate = *session_->certificate();
    EXPECT_TRUE(certificate.settled);
    EXPECT_THAT(warnings_of(certificate, session_->state().rest->topology()), ::testing::IsEmpty());
    EXPECT_LT(certificate.detail_error, 0.1);
    drag(twisted(60.0));
  }
}

TEST_F(ASession, CertificateGoesWithItsResult) {
  EXPECT_EQ(session_->certificate(), nullptr);
  drag(bent());
  const double first = session_->certificate()->largest_rotation_degrees;
  drag(twisted(120.0));
  const double second = session_->certificate()->largest_rotation_degrees;
  EXPECT_GT(second, first + 30.0);
  while (session_->history().can_undo()) {
    session_->undo();
    EXPECT_EQ(session_->certificate() != nullptr, session_->state().settled != nullptr);
  }
  session_->go_to(3);
  EXPECT_EQ(session_->certificate()->largest_rotation_degrees, first);
  session_->go_to(4);
  EXPECT_EQ(session_->certificate()->largest_rotation_degrees, second);
  crash_and_restore();
  ASSERT_NE(session_->certificate(), nullptr) << "restored";
  EXPECT_EQ(session_->certificate()->largest_rotation_degrees, second);
  session_->perform(Commit{});
  EXPECT_EQ(session_->certificate(), nullptr);
}

TEST_F(ASession, CancelledPreparationStartsAgainWhenAskedFor) {
  wait_for(PreparationStatus::Phase::ready);
  session_->cancel_preparation();
  EXPECT_EQ(session_->preparation().status().phase, PreparationStatus::Phase::idle);
  EXPECT_EQ(session_->preparation().preview(), nullptr);
  session_->perform(MoveHandle{0, bent()});
  session_->cancel_preparation();
  session_->prepare();
  wait_for_result();
}

TEST_F(ASession, LiveResultIsNoStep) {
  const Positions live = follow_to_the_end({bent()}, {});
  EXPECT_FALSE(session_->take_result());
  EXPECT_EQ(session_->history().done(), 2U);
  EXPECT_FALSE(is_moved(session_->state()));
  drag(bent());
  EXPECT_LT(largest_distance(live, positions()), 1e-3) << "what was seen is what comes";
}

TEST_F(ASession, StandsAtAPoseWhereItIsSettledAlone) {
  wait_for(PreparationStatus::Phase::ready);
  EXPECT_EQ(session_->pose(), nullptr) << "at rest";
  session_->perform(MoveHandle{0, bent()});
  EXPECT_EQ(session_->pose(), nullptr) << "the result is on its way";
  wait_for_result();
  ASSERT_NE(session_->pose(), nullptr);
  EXPECT_LT(largest_distance(positions_at(session_->state(), *session_->pose()), positions()),
            1e-12);
}

TEST_F(ASession, ASettledHandleTakenHoldOfAgainMovesNothing) {
  drag(twisted(70.0));
  const Positions before = positions();
  const Positions again = follow_to_the_end(session_->state().moves, session_->pose());
  EXPECT_LT(largest_distance(again, before), 1e-12);
}

TEST_F(ASession, ADragIsRestoredToItsBits) {
  // From another pose a minimization ends in other last bits.
  const auto drag_from = [this](const Move& shown, const Move& move) {
    const std::vector<HandleMove> moves{HandleMove(shown)};
    wait_for(PreparationStatus::Phase::ready);
    session_->settle_live(moves, nullptr);
    wait_for(PreparationStatus::Phase::ready);
    session_->perform(MoveHandle{0, move}, Joining::own_step,
                      session_->take_live_result().value().pose);
    wait_for_result();
  };
  drag_from(twisted(20.0), twisted(70.0));
  session_->perform(Commit{});
  const Positions committed = session_->state().rest->positions;
  session_->perform(Choose{kHandle, box(2.8, 4.0)});
  drag_from(twisted(-10.0), bent());
  const Positions seen = positions();
  const double turn = session_->certificate()->largest_rotation_degrees;
  {
    CpuKernels kernels;
    const History by_its_moves = from_draft(
        open_state(read_mesh(mesh_)), read_journal(journal())->draft, carry_out_with(kernels));
    EXPECT_NE(positions_of(by_its_moves.state()), seen) << "nothing is shown";
  }
  for (const char* time : {"after a crash", "after another"}) {
    crash_and_restore();
    EXPECT_EQ(positions(), seen) << time;
    EXPECT_EQ(session_->state().rest->positions, committed) << time;
    EXPECT_NEAR(session_->certificate()->largest_rotation_degrees, turn, 1e-3) << time;
    EXPECT_TRUE(session_->certificate()->settled);
  }
}

TEST_F(ASession, EveryCrashIsRestoredAlsoWhenItsMeshWasSavedOver) {
  drag(bent());
  session_->perform(Commit{});
  session_->save(mesh_);
  drag(twisted(60.0));
  const Positions before = positions();
  for (int crash = 0; crash < 3; ++crash) {
    const InterruptedEdit edit = crash_and_restore();
    EXPECT_EQ(edit.opened, mesh_);
    EXPECT_EQ(edit.step_count(), 2U);
    EXPECT_FALSE(std::filesystem::exists(edit.mesh.path)) << "discarded";
    EXPECT_LT(largest_distance(positions(), before), 1e-9) << "crash " << crash;
  }
}

TEST_F(ASession, RestoredSavesToTheFileThatWasOpened) {
  drag(bent());
  session_->save(mesh_);
  crash_and_restore();
  EXPECT_EQ(session_->file(), mesh_);
  EXPECT_TRUE(session_->history().unsaved());
  drag(twisted(60.0));
  session_->save(session_->file());
  EXPECT_FALSE(session_->history().unsaved());
  EXPECT_LT(largest_distance(read_mesh(mesh_).positions, positions()), 1e-6);
  const Positions before = positions();
  crash_and_restore();
  EXPECT_LT(largest_distance(positions(), before), 1e-9);
  session_->close();
  EXPECT_TRUE(std::filesystem::is_empty(cache_));
}

TEST_F(ASession, RestoredWithoutASaveKeepsNoCopy) {
  drag(bent());
  const Positions before = positions();
  EXPECT_FALSE(crash_and_restore().has_copy());
  EXPECT_FALSE(crash_and_restore().has_copy());
  EXPECT_LT(largest_distance(positions(), before), 1e-9);
}

TEST_F(ASession, RestoredAfterUndoCanRedo) {
  drag(bent());
  const Positions first = positions();
  session_->perform(Choose{kHandle, box(2.8, 4.0)});
  drag(twisted(-10.0));
  const Positions second = positions();
  session_->undo();
  session_->undo();
  for (const char* time : {"after a crash", "after another"}) {
    crash_and_restore();
    EXPECT_EQ(positions(), first) << time;
    EXPECT_TRUE(session_->history().can_redo()) << time;
  }
  while (session_->history().can_redo()) session_->redo();
  EXPECT_EQ(positions(), second);
}

TEST_F(ASession, RestoredAfterUndoCanRedoALaterMoveOfTheSameHandle) {
  drag(bent());
  const Positions first = positions();
  drag(twisted(-10.0));
  const Positions second = positions();
  session_->perform(Choose{kHandle, box(2.6, 4.0)});
  drag(bent());
  const Positions third = positions();
  session_->go_to(3);
  ASSERT_EQ(positions(), first);
  crash_and_restore();
  EXPECT_EQ(positions(), first);
  session_->redo();
  EXPECT_EQ(positions(), second);
  while (session_->history().can_redo()) session_->redo();
  EXPECT_EQ(positions(), third);
}

TEST_F(ASession, RestoredAfterUndoCanRedoEachMoveOfAHandle) {
  const Positions rest = positions();
  const std::size_t before = session_->history().done();
  drag(bent());
  const Positions first = positions();
  drag(twisted(-10.0));
  const Positions second = positions();
  session_->go_to(before);
  for (const char* time : {"after a crash", "after another"}) {
    crash_and_restore();
    EXPECT_EQ(positions(), rest) << time;
    session_->redo();
    EXPECT_EQ(positions(), first) << time;
    session_->redo();
    EXPECT_EQ(positions(), second) << time;
    EXPECT_FALSE(session_->history().can_redo()) << time;
    session_->undo();
    session_->undo();
  }
}

TEST_F(ASession, GrabThatACrashInterruptsIsNoStep) {
  drag(bent());
  const Positions before = positions();
  const RegionSpec disk{GeodesicDisk{Index{20}, 1.2}, "ROI"};
  session_->perform(Grab{choose(disk, *surface_of(session_->state())),
                         {GeodesicDisk{Index{20}, 0.3}, "handle"},
                         {.transition = Transition{.width = 0.3}}});
  crash_and_restore();
  EXPECT_THAT(session_->history().names(), ::testing::Not(::testing::Contains("Grab")));
  EXPECT_EQ(positions(), before);
  EXPECT_TRUE(session_->state().settled);
}

TEST_F(ASession, GrabsAreRestoredAsTheStepsThatTheyWere) {
  const auto grab = [this](Index center) {
    const RegionSpec disk{GeodesicDisk{center, 1.2}, "ROI"};
    const RegionSpec handle{GeodesicDisk{center, 0.3}, "handle"};
    session_->perform(Grab{choose(disk, *surface_of(session_->state())),
                           handle,
                           {.transition = Transition{.width = 0.3}}});
    session_->perform(MoveHandle{0, bent()}, Joining::with_last);
    wait_for_result();
  };
  session_->undo();
  session_->undo();
  grab(20);
  const Positions first = positions();
  grab(100);
  const Positions second = positions();
  session_->undo();
  crash_and_restore();
  EXPECT_THAT(session_->history().names(), ElementsAre("Grab", "Grab"));
  EXPECT_EQ(positions(), first);
  session_->redo();
  EXPECT_EQ(positions(), second);
  session_->go_to(0);
  EXPECT_EQ(positions(), read_mesh(mesh_).positions);
}

TEST_F(ASession, RestoredAfterUndoAndAnotherStepHasNothingToRedo) {
  drag(bent());
  session_->undo();
  drag(twisted(20.0));
  const Positions before = positions();
  crash_and_restore();
  EXPECT_EQ(positions(), before);
  EXPECT_FALSE(session_->history().can_redo());
}

TEST_F(ASession, RestoredSettlesTheMoveThatWasOnItsWay) {
  session_->perform(MoveHandle{0, bent()});
  crash_and_restore();
  wait_for_result();
  EXPECT_FALSE(needs_settling(session_->state()));
}

TEST_F(ASession, ARecipeSavedAfterTheOpenedFileWasReplacedStartsFromACopyOfTheOriginal) {
  const Positions original = read_mesh(mesh_).positions;
  drag(bent());
  session_->save(mesh_);
  const auto expect_bends_once = [&](const std::string& copy) {
    EXPECT_EQ(session_->save_recipe(folder_ / "recipe.json"), folder_ / copy);
    const Recipe recipe = read_recipe(folder_ / "recipe.json");
    EXPECT_EQ(recipe.mesh, copy);
    EXPECT_EQ(read_mesh(folder_ / copy).positions, original);
    CpuKernels kernels;
    EXPECT_LT(largest_distance(run_recipe(recipe, kernels)->mesh.positions, positions()), 1e-9);
  };
  expect_bends_once("tube-original.obj");
  expect_bends_once("tube-original.obj");
  crash_and_restore();
  expect_bends_once("tube-original.obj");
  replace_file(folder_ / "tube-original.obj", "precious");
  expect_bends_once("tube-original-2.obj");
  EXPECT_EQ(std::filesystem::file_size(folder_ / "tube-original.obj"), 8U);
}

TEST_F(ASession, WithoutAPlaceForItsJournalItGoesOn) {
  EditSession session(History(open_state(bumpy_tube())), stamp_of(mesh_), mesh_ / "inside",
                      cpu_kernels);
  EXPECT_FALSE(session.warning().empty());
  session.perform(Choose{kRoi, box(0.3, 4.0)});
  EXPECT_EQ(session.history().done(), 1U);
}

TEST_F(ASession, GeneratedMeshHasNoRecipeToSave) {
  EditSession session(History(open_state(bumpy_tube())), {}, cache_, cpu_kernels);
  EXPECT_THROW(session.save_recipe(folder_ / "recipe.json"), InputError);
  EXPECT_EQ(session.warning(), "");
}

}  // namespace
}  // namespace lapwing::viewer::test
