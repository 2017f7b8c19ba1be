// Steps carried out beside the window.
#include <atomic>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "lapwing/base/errors.h"
#include "support/error_message.h"
#include "viewer_state/sheet_edit.h"
#include "viewer_state/tube_edit.h"
#include "work/crash_recovery.h"
#include "work/edit_session.h"

namespace lapwing::viewer::test {
namespace {

using lapwing::test::largest_distance;
using ::testing::HasSubstr;

TEST(Job, HasTheResultOnce) {
  Job<int> job(cpu_kernels);
  EXPECT_FALSE(job.take());
  job.start([](const auto& kernels, const Progress& progress) {
    report_progress(progress, "count", 0.5);
    return kernels != nullptr ? 7 : 0;
  });
  EXPECT_EQ(awaited([&] { return job.take(); }), 7);
  EXPECT_FALSE(job.take());
  EXPECT_FALSE(job.status().busy);
}

TEST(Job, TellsHowFarItIsAndIsCancelledThere) {
  std::atomic<bool> looked = false;
  std::atomic<bool> went_on = false;
  {
    Job<int> job(cpu_kernels);
    job.start([&](const auto&, const Progress& progress) {
      report_progress(progress, "count", 0.25);
      wait_until([&] { return looked.load(); });
      report_progress(progress, "count", 0.5);
      went_on = true;
      return 7;
    });
    wait_until([&] { return job.status().stage == "count"; });
    EXPECT_TRUE(job.status().busy);
    EXPECT_EQ(job.status().fraction, 0.25);
    job.cancel();
    EXPECT_FALSE(job.status().busy);
    looked = true;
    job.start([](const auto&, const Progress&) { return 8; });
    EXPECT_EQ(awaited([&] { return job.take(); }), 8) << "not that of the one given up";
  }
  EXPECT_FALSE(went_on);
}

TEST(Job, ThrowsWhatItsWorkThrewOnce) {
  Job<int> job(cpu_kernels);
  job.start([](const auto&, const Progress&) -> int { throw InputError("no such mesh"); });
  std::string said;
  while (said.empty()) said = error_message<InputError>([&] { job.take(); });
  EXPECT_EQ(said, "no such mesh");
  EXPECT_FALSE(job.take());
}

TEST(Job, BeginsAnewWithOtherKernelsWhereTheDeviceWasLost) {
  std::atomic<int> made = 0;
  const auto make = [&made] {
    ++made;
    return std::make_unique<CpuKernels>();
  };
  Job<int> job(make);
  job.start([&made](const auto&, const Progress&) {
    if (made == 1) throw GpuError("the device was lost");
    return made.load();
  });
  std::string said;
  while (said.empty()) said = error_message<GpuError>([&] { job.take(); });
  job.use_kernels(make);
  EXPECT_EQ(awaited([&] { return job.take(); }), 2);
}

class AStepSession : public ::testing::Test {
 protected:
  AStepSession() { open(History(open_state(read_mesh(files_.sheet())))); }

  void open(History history) {
    session_.emplace(std::move(history), stamp_of(files_.sheet()), cache(), cpu_kernels);
  }
  std::filesystem::path cache() const { return files_.folder() / "cache"; }
  StepTaken wait_for_step() {
    return awaited([&] { return session_->take_step(); });
  }
  std::string wait_for_failure() {
    std::string said;
    wait_until([&] {
      said = error_message<Error>([&] { session_->take_step(); });
      return !said.empty();
    });
    return said;
  }
  Positions positions() const { return positions_of(session_->state()); }
  Mesh headless() {
    const auto path = files_.folder() / "recipes" / "coat.json";
    std::filesystem::create_directories(path.parent_path());
    session_->save_recipe(path);
    CpuKernels kernels;
    return run_recipe(read_recipe(path), kernels)->mesh;
  }

  SheetAndRelief files_;
  std::optional<EditSession> session_;
};

TEST_F(AStepSession, CarriesOutAStepThatIsUndoneAndRedone) {
  const Positions before = positions();
  session_->carry_out(files_.coat(1.0, Remeshing::automatic));
  EXPECT_TRUE(session_->is_carrying_out());
  EXPECT_TRUE(wait_for_step().changed_triangles);
  EXPECT_FALSE(session_->is_carrying_out());
  const Mesh coated = mesh_of(session_->state());
  EXPECT_GT(coated.vertex_count(), before.size());
  session_->undo();
  EXPECT_EQ(positions(), before);
  session_->redo();
  EXPECT_TRUE(same_mesh(mesh_of(session_->state()), coated));
  EXPECT_TRUE(same_mesh(headless(), coated)) << "its recipe, from another folder";
}

TEST_F(AStepSession, FindsASourceBesideItsMesh) {
  CoatStep step = files_.coat();
  step.source.mesh = "../sources/relief.ply";
  session_->carry_out(step);
  wait_for_step();
  EXPECT_EQ(*session_->state().steps.at(0), Step(files_.coat()));
}

TEST_F(AStepSession, CancelledChangesNothing) {
  const AppState before = session_->state();
  session_->carry_out(files_.coat());
  session_->cancel_step();
  EXPECT_FALSE(session_->is_carrying_out());
  EXPECT_FALSE(session_->step_status().busy);
  std::this_thread::sleep_for(std::chrono::milliseconds(30));
  EXPECT_FALSE(session_->take_step());
  EXPECT_TRUE(same(session_->state(), before));
  EXPECT_EQ(session_->history().size(), 0U);
}

TEST_F(AStepSession, FailedSaysWhyAndChangesNothing) {
  CoatStep step = files_.coat();
  step.source.mesh = "nowhere.ply";
  session_->carry_out(step);
  EXPECT_THAT(wait_for_failure(), HasSubstr("nowhere.ply"));
  EXPECT_FALSE(session_->is_carrying_out());
  EXPECT_EQ(session_->history().size(), 0U);
}

TEST_F(AStepSession, GoesOnWhileSomethingIsChosenButNotOnAnotherSurface) {
  session_->carry_out(files_.coat());
  session_->perform(Choose{kRoi, {GeodesicDisk{Index{80}, 0.2}}});
  EXPECT_TRUE(session_->is_carrying_out());
  wait_for_step();
  EXPECT_FALSE(session_->state().selection.roi.vertices.empty());
  session_->carry_out(files_.coat());
  session_->undo();
  EXPECT_FALSE(session_->is_carrying_out());
  std::this_thread::sleep_for(std::chrono::milliseconds(30));
  EXPECT_FALSE(session_->take_step());
}

TEST_F(AStepSession, TakesAStepUpAgain) {
  session_->carry_out(files_.coat(1.0));
  wait_for_step();
  session_->carry_out(files_.coat(0.5));
  wait_for_step();
  const Positions before = positions();
  session_->replace_step(0, files_.coat(2.0));
  wait_for_step();
  EXPECT_GT(largest_distance(positions(), before), 1e-3);
  EXPECT_TRUE(same_mesh(headless(), mesh_of(session_->state())));
  session_->undo();
  EXPECT_EQ(positions(), before);
  EXPECT_EQ(*session_->state().steps.at(0), Step(files_.coat(1.0)));
}

TEST_F(AStepSession, ACrashLosesNoStep) {
  session_->carry_out(files_.coat(1.0, Remeshing::automatic));
  wait_for_step();
  session_->replace_step(0, files_.coat(2.0, Remeshing::automatic));
  wait_for_step();
  const Mesh left = mesh_of(session_->state());
  session_.reset();  // as a crash does, it closes nothing
  const auto edits = find_interrupted(cache());
  ASSERT_EQ(edits.size(), 1U);
  CpuKernels kernels;
  const History restored =
      restore_after_crash(open_state(read_mesh(files_.sheet())), edits[0], kernels);
  EXPECT_TRUE(same_mesh(mesh_of(restored.state()), left));
}

}  // namespace
}  // namespace lapwing::viewer::test
