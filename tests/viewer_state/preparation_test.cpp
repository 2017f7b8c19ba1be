#include "tools/preparation.h"

#include <atomic>
#include <chrono>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "lapwing/base/errors.h"
#include "viewer_state/tube_edit.h"

namespace lapwing::viewer::test {
namespace {

using ::testing::HasSubstr;
using Phase = PreparationStatus::Phase;
using lapwing::test::largest_distance;

// Holds the worker at each new set of kernels until it is let through.
class Gate {
 public:
  std::unique_ptr<Kernels> make_kernels() {
    std::unique_lock lock(mutex_);
    ++waiting_;
    changed_.notify_all();
    changed_.wait(lock, [this] { return passes_ > 0; });
    --passes_;
    --waiting_;
    return cpu_kernels();
  }
  void let_through(int count) {
    const std::lock_guard lock(mutex_);
    passes_ += count;
    changed_.notify_all();
  }
  void wait_for_worker() {
    std::unique_lock lock(mutex_);
    changed_.wait(lock, [this] { return waiting_ > 0; });
  }

 private:
  std::mutex mutex_;
  std::condition_variable changed_;
  int passes_ = 0;
  int waiting_ = 0;
};

PreparationStatus wait_for(const Preparation& preparation, Phase phase) {
  PreparationStatus status = preparation.status();
  while (status.phase != phase) {
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
    status = preparation.status();
  }
  return status;
}

SettledResult wait_for_result(Preparation& preparation) {
  for (;;) {
    if (auto result = preparation.take_result()) return *std::move(result);
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
}

// Where a drag is brought next, as soon as that is possible.
std::shared_ptr<const MovedVertices> follow(Preparation& preparation, const AppState& dragged) {
  wait_for(preparation, Phase::ready);
  EXPECT_TRUE(preparation.settle_live(dragged));
  wait_for(preparation, Phase::ready);
  return preparation.take_live_result();
}

double distance(const AppState& state, const MovedVertices& a, const MovedVertices& b) {
  const auto positions = [&state](const MovedVertices& moved) {
    return positions_of(apply(state, Settle{std::make_shared<const MovedVertices>(moved)}));
  };
  return largest_distance(positions(a), positions(b));
}

// The same without a worker.
struct PreparedTube {
  PreparedTube(const AppState& state, Kernels& kernels)
      : rest(state.rest->positions),
        deformer(rest, *state.topology, edit_region(state), deform_options(state.parameters),
                 kernels) {}
  MovedVertices moved(const SettledPose& pose) const {
    Positions positions = rest;
    for (std::size_t v = 0; v < rest.size(); ++v) positions[v] += pose.displacement[v];
    return moved_vertices(rest, positions);
  }
  const Positions& rest;
  Deformer deformer;
};

TEST(Preparation, PreviewComesFirstThenTheExactOne) {
  Gate gate;
  Preparation preparation([&gate] { return gate.make_kernels(); });
  preparation.follow(chosen_tube());
  EXPECT_EQ(preparation.preview(), nullptr);
  gate.let_through(1);
  wait_for(preparation, Phase::solving);
  EXPECT_NE(preparation.preview(), nullptr);
  EXPECT_EQ(preparation.exact(), nullptr);
  gate.let_through(1);
  EXPECT_EQ(wait_for(preparation, Phase::ready).fraction, 1.0);
  EXPECT_NE(preparation.exact(), nullptr);
}

TEST(Preparation, PreviewIsDraggedWhileTheExactOneIsMade) {
  Preparation preparation(cpu_kernels);
  const AppState state = apply(chosen_tube(), MoveHandle{0, bent()});
  preparation.follow(state);
  const auto motions = motions_of(state);
  int frames = 0;
  while (preparation.status().phase != Phase::ready) {
    if (const auto preview = preparation.preview()) {
      preview->drag(motions);
      ++frames;
    }
  }
  preparation.exact()->drag(motions);
  EXPECT_GT(largest_distance(preparation.exact()->surface().positions(), state.rest->positions),
            0.3);
}

TEST(Preparation, SettlesAsADeformerMadeAtOnceDoes) {
  const AppState state = apply(chosen_tube(), MoveHandle{0, twisted(100.0)});
  Preparation preparation(cpu_kernels);
  preparation.follow(state);
  preparation.settle(state);
  const SettledResult result = wait_for_result(preparation);
  EXPECT_EQ(result.moves, state.moves);
  CpuKernels kernels;
  const auto expected = carry_out_with(kernels).solve(state);
  const AppState settled = apply(state, Settle{result.moved});
  EXPECT_LT(largest_distance(positions_of(settled), positions_of(apply(state, Settle{expected}))),
            1e-9);
  EXPECT_TRUE(result.certificate.settled);
  wait_for(preparation, Phase::ready);
}

TEST(Preparation, CommitsOnTheWayWhereTheParametersSaySo) {
  AppState state = apply(chosen_tube(), SetParameters{{.commit_every = 60.0}});
  state = apply(state, MoveHandle{0, twisted(100.0)});
  Preparation preparation(cpu_kernels);
  preparation.follow(state);
  preparation.settle(state);
  CpuKernels kernels;
  const Solved expected = solve_open_step(state, kernels);
  const SettledResult result = wait_for_result(preparation);
  EXPECT_EQ(*result.moved, *expected.moved);
  EXPECT_EQ(result.certificate.settle_iterations, expected.certificate.settle_iterations);
}

TEST(Preparation, AMoveAloneStartsNothingAnew) {
  Preparation preparation(cpu_kernels);
  const AppState state = chosen_tube();
  preparation.follow(state);
  wait_for(preparation, Phase::ready);
  const auto exact = preparation.exact();
  preparation.follow(apply(state, MoveHandle{0, bent()}));
  EXPECT_EQ(preparation.exact(), exact);
}

TEST(Preparation, AnotherSelectionStartsAnew) {
  Preparation preparation(cpu_kernels);
  const AppState state = chosen_tube();
  preparation.follow(state);
  wait_for(preparation, Phase::ready);
  const auto before = preparation.exact();
  preparation.follow(apply(state, Choose{kHandle, box(2.5, 4.0)}));
  EXPECT_NE(preparation.exact(), before);
  wait_for(preparation, Phase::ready);
  EXPECT_EQ(preparation.exact()->region().handles[0].size(), 48U);
}

TEST(Preparation, AnotherHandleOnTheSameRoiOrdersNothingAnew) {
  Preparation preparation(cpu_kernels);
  const auto orders = [&](const AppState& state) {
    preparation.follow(state);
    wait_for(preparation, Phase::ready);
    const StageTimings timings = preparation.exact()->timings();
    return std::any_of(timings.stages().begin(), timings.stages().end(),
                       [](const auto& stage) { return stage.first == "order"; });
  };
  AppState state = chosen_tube();
  EXPECT_TRUE(orders(state));
  state = apply(state, Choose{kHandle, box(2.5, 4.0)});
  EXPECT_FALSE(orders(state));
  state = apply(state, SetParameters{{.constraint_weight = 2.0}});
  EXPECT_FALSE(orders(state));
  EXPECT_TRUE(orders(apply(state, Choose{kRoi, box(0.4, 4.0)})));
  preparation.cancel();
  EXPECT_TRUE(orders(state)) << "nothing is kept";
}

TEST(Preparation, TheLatestSelectionWinsHoweverFastTheyChange) {
  Preparation preparation(cpu_kernels);
  AppState state = chosen_tube();
  for (int k = 0; k < 50; ++k) {
    state = apply(state, Choose{kHandle, box(k % 2 == 0 ? 2.5 : 2.8, 4.0)});
    preparation.follow(state);
    if (k % 7 == 0) std::this_thread::sleep_for(std::chrono::milliseconds(k % 5));
  }
  wait_for(preparation, Phase::ready);
  EXPECT_EQ(preparation.exact()->region().handles[0], state.selection.handles[0].vertices);
}

TEST(Preparation, CancelledHasNothingReady) {
  Gate gate;
  Preparation preparation([&gate] { return gate.make_kernels(); });
  preparation.follow(chosen_tube());
  gate.wait_for_worker();
  preparation.cancel();
  gate.let_through(1);
  EXPECT_EQ(preparation.status().phase, Phase::idle);
  preparation.follow(chosen_tube());
  gate.let_through(2);
  wait_for(preparation, Phase::ready);
}

TEST(Preparation, SettlingCanBeCancelledAndAskedForAgain) {
  AppState state =
      apply(chosen_tube(), SetParameters{{.settle = SettleOptions{.tolerance = 1e-9}}});
  state = apply(state, MoveHandle{0, twisted(170.0)});
  Preparation preparation(cpu_kernels);
  preparation.follow(state);
  wait_for(preparation, Phase::ready);
  preparation.settle(state);
  preparation.cancel_settling();
  wait_for(preparation, Phase::ready);
  EXPECT_FALSE(preparation.take_result().has_value());
  preparation.settle(state);
  EXPECT_EQ(wait_for_result(preparation).moves, state.moves);
}

TEST(Preparation, TheLastResultAskedForComes) {
  const AppState first = apply(chosen_tube(), MoveHandle{0, twisted(170.0)});
  const AppState last = apply(first, MoveHandle{0, bent()});
  Preparation preparation(cpu_kernels);
  preparation.follow(first);
  preparation.settle(first);
  preparation.settle(last);
  EXPECT_EQ(wait_for_result(preparation).moves, last.moves);
}

TEST(Preparation, LiveResultComesByItself) {
  const AppState still = chosen_tube();
  std::atomic<bool> held = false;  // the worker, at what it says next
  Preparation preparation(cpu_kernels, [&held] { held.wait(true); });
  preparation.follow(still);
  wait_for(preparation, Phase::ready);
  const AppState dragged = apply(still, MoveHandle{0, bent()});
  held = true;
  EXPECT_TRUE(preparation.settle_live(dragged));
  EXPECT_EQ(preparation.status().phase, Phase::settling) << "the exact one may not be dragged now";
  held = false;
  held.notify_all();
  wait_for(preparation, Phase::ready);
  EXPECT_FALSE(preparation.take_result().has_value());
  CpuKernels kernels;
  const auto live = preparation.take_live_result();
  EXPECT_LT(distance(dragged, *live, *carry_out_with(kernels).solve(dragged)), 1e-3);
  EXPECT_EQ(preparation.take_live_result(), nullptr);
}

TEST(Preparation, LiveResultsGoOnFromOneToTheNext) {
  const AppState still = chosen_tube();
  CpuKernels kernels;
  const PreparedTube expected(still, kernels);
  Preparation preparation(cpu_kernels);
  preparation.follow(still);
  SettledPose pose;
  for (const double degrees : {10.0, 20.0, 30.0}) {
    const AppState dragged = apply(still, MoveHandle{0, twisted(degrees)});
    expected.deformer.follow(motions_of(dragged), turns_of(dragged), pose);
    EXPECT_EQ(distance(dragged, *follow(preparation, dragged), expected.moved(pose)), 0.0)
        << degrees << " degrees";
  }
}

// From where the last drag ended, the result would be another one within the tolerance.
TEST(Preparation, ADragBeginsAnewAfterAnythingElse) {
  const AppState still = chosen_tube();
  const AppState far = apply(still, MoveHandle{0, twisted(10.0)});
  const AppState near = apply(still, MoveHandle{0, twisted(5.0)});
  Preparation preparation(cpu_kernels);
  preparation.follow(still);
  const auto first = follow(preparation, near);
  const auto drag_anew = [&](auto between) {
    follow(preparation, far);
    between();
    return *follow(preparation, near) == *first;
  };
  EXPECT_FALSE(drag_anew([] {}));
  EXPECT_TRUE(drag_anew([&] { preparation.cancel_settling(); }));
  EXPECT_TRUE(drag_anew([&] {
    preparation.settle(far);
    wait_for_result(preparation);
  }));
  EXPECT_TRUE(drag_anew([&] {
    preparation.follow(apply(still, SetParameters{{.constraint_weight = 2.0}}));
    preparation.follow(still);
  }));
}

// A second drag of a handle that is turned by more than half a turn already.
TEST(Preparation, LiveResultIsWoundTheWayTheHandleWent) {
  const AppState dragged = apply(chosen_tube(), MoveHandle{0, twisted(200.0)});
  Preparation preparation(cpu_kernels);
  preparation.follow(dragged);
  CpuKernels kernels;
  EXPECT_LT(
      distance(dragged, *follow(preparation, dragged), *carry_out_with(kernels).solve(dragged)),
      1e-3);
}

TEST(Preparation, LiveResultWithoutSettlingIsTheLinearOne) {
  AppState state = apply(chosen_tube(), SetParameters{{.settle = std::nullopt}});
  state = apply(state, MoveHandle{0, bent()});
  Preparation preparation(cpu_kernels);
  preparation.follow(state);
  CpuKernels kernels;
  EXPECT_EQ(*follow(preparation, state), *carry_out_with(kernels).solve(state));
}

TEST(Preparation, LiveResultCommitsOnTheWayToo) {
  AppState state = apply(chosen_tube(), SetParameters{{.commit_every = 60.0}});
  state = apply(state, MoveHandle{0, twisted(100.0)});
  Preparation preparation(cpu_kernels);
  preparation.follow(state);
  CpuKernels kernels;
  EXPECT_EQ(*follow(preparation, state), *solve_open_step(state, kernels).moved);
}

TEST(Preparation, LiveResultIsNotAskedForWhileAnythingElseIs) {
  const AppState state = apply(chosen_tube(), MoveHandle{0, bent()});
  Preparation preparation(cpu_kernels);
  preparation.follow(state);
  EXPECT_FALSE(preparation.settle_live(state)) << "nothing is ready yet";
  preparation.settle(state);
  EXPECT_FALSE(preparation.settle_live(state));
  wait_for(preparation, Phase::ready);
  EXPECT_FALSE(preparation.settle_live(state)) << "the result waits to be taken";
  EXPECT_TRUE(preparation.take_result().has_value());
  EXPECT_TRUE(preparation.settle_live(state));
  EXPECT_FALSE(preparation.settle_live(state)) << "one after the other";
}

TEST(Preparation, SettlingTakesThePlaceOfALiveResult) {
  AppState state =
      apply(chosen_tube(), SetParameters{{.settle = SettleOptions{.tolerance = 1e-9}}});
  Preparation preparation(cpu_kernels);
  preparation.follow(state);
  wait_for(preparation, Phase::ready);
  EXPECT_TRUE(preparation.settle_live(apply(state, MoveHandle{0, twisted(170.0)})));
  state = apply(state, MoveHandle{0, bent()});
  preparation.settle(state);
  EXPECT_EQ(wait_for_result(preparation).moves, state.moves);
  EXPECT_EQ(preparation.take_live_result(), nullptr);
}

TEST(Preparation, NothingChosenIsNothingToPrepare) {
  Preparation preparation(cpu_kernels);
  preparation.follow(open_state(bumpy_tube()));
  EXPECT_EQ(preparation.status().phase, Phase::idle);
}

TEST(Preparation, FailureSaysWhy) {
  Preparation preparation(cpu_kernels);
  preparation.follow(apply(chosen_tube(), Paint{kHandle, {0}, {}}));
  EXPECT_THAT(wait_for(preparation, Phase::failed).message, HasSubstr("leaves the roi"));
}

TEST(Preparation, DeviceThatFailsIsAFailureToo) {
  Preparation preparation([]() -> std::unique_ptr<Kernels> { throw GpuError("device lost"); });
  preparation.follow(chosen_tube());
  EXPECT_EQ(wait_for(preparation, Phase::failed).message, "device lost");
}

TEST(Preparation, WakesTheWindowWhenSomethingChanged) {
  std::atomic<int> woken = 0;
  {
    Preparation preparation(cpu_kernels, [&woken] { ++woken; });
    preparation.follow(chosen_tube());
    wait_for(preparation, Phase::ready);
  }
  EXPECT_GE(woken, 10);
}

TEST(Preparation, WhatIsHeldOutlivesIt) {
  std::shared_ptr<Deformer> exact;
  std::vector<Eigen::Affine3d> motions;
  {
    Preparation preparation(cpu_kernels);
    const AppState state = apply(chosen_tube(), MoveHandle{0, bent()});
    motions = motions_of(state);
    preparation.follow(state);
    wait_for(preparation, Phase::ready);
    exact = preparation.exact();
  }
  exact->drag(motions);
  EXPECT_FALSE(exact->surface().positions().empty());
}

}  // namespace
}  // namespace lapwing::viewer::test
