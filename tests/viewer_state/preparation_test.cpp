#include "work/preparation.h"

#include <atomic>
#include <semaphore>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "lapwing/base/errors.h"
#include "lapwing/mesh/shapes.h"
#include "support/dragged.h"
#include "viewer_state/tube_edit.h"

namespace lapwing::viewer::test {
namespace {

using ::testing::HasSubstr;
using Phase = PreparationStatus::Phase;
using lapwing::test::largest_distance;

// Holds the worker at the kernels of each exact response until it is let through.
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
  wait_until([&] { return preparation.status().phase == phase; });
  return preparation.status();
}

SettledResult wait_for_result(Preparation& preparation) {
  return awaited([&] { return preparation.take_result(); });
}

// A Preparation that has finished preparing `state`.
struct ReadyFor : Preparation {
  explicit ReadyFor(const AppState& state) : Preparation(cpu_kernels) {
    follow(state);
    wait_for(*this, Phase::ready);
  }
};

using Pose = std::shared_ptr<const DragState>;

// Where a drag is brought next, as soon as that is possible.
LiveResult follow(Preparation& preparation, const AppState& dragged, const Pose& from,
                  bool rests = false) {
  wait_for(preparation, Phase::ready);
  EXPECT_TRUE(preparation.settle_live(dragged, from, rests));
  wait_for(preparation, Phase::ready);
  return preparation.take_live_result().value();
}

// The same, asked for again until nothing is left to settle.
Pose follow_to_the_end(Preparation& preparation, const AppState& dragged, Pose from = {}) {
  for (bool rests = false;; rests = true) {
    const LiveResult result = follow(preparation, dragged, from, rests);
    if (result.is_done) return result.pose;
    from = result.pose;
  }
}

Positions solved(const AppState& state) {
  CpuKernels kernels;
  return positions_of(apply(state, Settle{carry_out_with(kernels).solve(state)}));
}

// Beyond what settling to its tolerance leaves open, for a tube 3 long.
constexpr double kSettled = 1e-3;

TEST(Preparation, PreviewComesFirstThenTheExactOne) {
  Gate gate;
  Preparation preparation([&gate] { return gate.make_kernels(); });
  EXPECT_EQ(preparation.preview(), nullptr);
  preparation.follow(chosen_tube());
  gate.wait_for_worker();
  EXPECT_EQ(preparation.status().phase, Phase::solving);
  EXPECT_NE(preparation.preview(), nullptr);
  EXPECT_EQ(preparation.exact(), nullptr);
  gate.let_through(1);
  EXPECT_EQ(wait_for(preparation, Phase::ready).fraction, 1.0);
  EXPECT_NE(preparation.exact(), nullptr);
}

TEST(Preparation, ItsProgressDoesNotGoBack) {
  for (const bool settles : {true, false}) {
    AppState state = chosen_tube();
    if (!settles) state.parameters.settle.reset();
    Preparation preparation(cpu_kernels);
    preparation.follow(state);
    double last = 0.0;
    for (PreparationStatus status; status.phase != Phase::ready;) {
      status = preparation.status();
      ASSERT_GE(status.fraction, last) << status.stage;
      last = status.fraction;
    }
    EXPECT_EQ(last, 1.0);
  }
}

TEST(Preparation, PreviewIsDraggedWhileTheExactOneIsMade) {
  Preparation preparation(cpu_kernels);
  const AppState state = apply(chosen_tube(), MoveHandle{0, bent()});
  preparation.follow(state);
  const auto motions = motions_of(state).maps;
  int frames = 0;
  while (preparation.status().phase != Phase::ready) {
    if (const auto preview = preparation.preview()) {
      lapwing::test::dragged(preview->response(), motions);
      ++frames;
    }
  }
  const Positions moved = lapwing::test::dragged(preparation.exact()->response(), motions);
  EXPECT_GT(largest_distance(moved, state.rest->positions), 0.3);
}

TEST(Preparation, AnotherHandleTakenInHandGetsColumnsOfItsOwn) {
  AppState state = apply(chosen_tube(), Choose{kSecondHandle, box(1.4, 1.7)});
  state.parameters.settle.reset();
  ReadyFor preparation(state);
  const auto exact = preparation.exact();
  EXPECT_EQ(preparation.drag_response().response->handles(), std::vector<std::size_t>{0});

  preparation.drag_by(std::array<std::size_t, 1>{1});
  wait_until([&] { return preparation.drag_response().response->handles().front() == 1; });
  EXPECT_EQ(preparation.exact(), exact) << "nothing else is prepared anew";
  EXPECT_TRUE(preparation.drag_response().is_exact);
  state = apply(std::move(state), MoveHandle{1, bent()});
  const auto motions = motions_of(state).maps;
  EXPECT_EQ(lapwing::test::dragged(preparation.drag_response().response, motions),
            lapwing::test::dragged(exact->response(), motions));
}

// A tube of 7,260 vertices along z from 0 to 6, which a coarse surface leads.
AppState chosen_large_tube() {
  AppState state = open_state(rippled_cylinder(60, 121));
  state = apply(std::move(state), Choose{kRoi, box(0.3, 7.0)});
  return apply(std::move(state), Choose{kHandle, box(5.6, 7.0)});
}

TEST(Preparation, DragsThatSettleGoByThePreviewAndComeToTheSame) {
  AppState state = chosen_large_tube();
  ReadyFor preparation(state);
  EXPECT_FALSE(preparation.drag_response().is_exact);
  EXPECT_EQ(preparation.drag_response().response, preparation.preview()->response());
  state = apply(std::move(state), MoveHandle{0, bent()});
  const Pose pose = follow_to_the_end(preparation, state);
  EXPECT_LT(largest_distance(positions_at(state, *pose), solved(state)), kSettled);
  state.parameters.settle.reset();
  EXPECT_TRUE(ReadyFor(state).drag_response().is_exact) << "without settling";
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
  EXPECT_TRUE(result.moved->certificate->settled);
  wait_for(preparation, Phase::ready);
}

TEST(Preparation, CommitsOnTheWayWhereTheParametersSaySo) {
  AppState state = apply(chosen_tube(), SetParameters{{.commit_every = 60.0}});
  state = apply(state, MoveHandle{0, twisted(100.0)});
  Preparation preparation(cpu_kernels);
  preparation.follow(state);
  preparation.settle(state);
  CpuKernels kernels;
  const auto expected = solve_open_step(state, kernels);
  const SettledResult result = wait_for_result(preparation);
  EXPECT_EQ(*result.moved, *expected);
  EXPECT_EQ(result.moved->certificate->settle_iterations, expected->certificate->settle_iterations);
}

TEST(Preparation, AnotherSelectionStartsAnewAndAMoveDoesNot) {
  const AppState state = chosen_tube();
  ReadyFor preparation(state);
  const auto before = preparation.exact();
  preparation.follow(apply(state, MoveHandle{0, bent()}));
  EXPECT_EQ(preparation.exact(), before);
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
  state = apply(state, SetParameters{{{.constraint_weight = 2.0}}});
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
  gate.let_through(1);
  wait_for(preparation, Phase::ready);
}

TEST(Preparation, SettlingCanBeCancelledAndAskedForAgain) {
  AppState state =
      apply(chosen_tube(), SetParameters{{{.settle = SettleOptions{.tolerance = 1e-9}}}});
  state = apply(state, MoveHandle{0, twisted(170.0)});
  ReadyFor preparation(state);
  preparation.settle(state);
  preparation.cancel_settling();
  wait_for(preparation, Phase::ready);
  EXPECT_FALSE(preparation.take_result().has_value());
  const AppState last = apply(state, MoveHandle{0, bent()});
  preparation.settle(state);
  preparation.settle(last);
  EXPECT_EQ(wait_for_result(preparation).moves, last.moves);
}

TEST(Preparation, LiveResultComesByItself) {
  const AppState still = chosen_tube();
  // The worker stops wherever it has something to say, until it may go on.
  std::counting_semaphore said(0);
  std::counting_semaphore may_go_on(0);
  Preparation preparation(cpu_kernels, [&] {
    said.release();
    may_go_on.acquire();
  });
  preparation.follow(still);
  for (said.acquire(); preparation.status().phase != Phase::ready; said.acquire()) {
    may_go_on.release();
  }
  const AppState dragged = apply(still, MoveHandle{0, bent()});
  EXPECT_TRUE(preparation.settle_live(dragged, {}));
  EXPECT_EQ(preparation.status().phase, Phase::settling) << "the exact one may not be dragged now";
  constexpr int kAlways = 1000;
  may_go_on.release(kAlways);
  wait_for(preparation, Phase::ready);
  EXPECT_FALSE(preparation.take_result().has_value());
  const auto live = preparation.take_live_result();
  ASSERT_TRUE(live.has_value());
  EXPECT_EQ(live->moves, dragged.moves);
  EXPECT_NE(live->pose, nullptr);
  EXPECT_FALSE(preparation.take_live_result().has_value());
}

TEST(Preparation, LiveResultThatRestsSettlesToWhatLettingGoComesTo) {
  const AppState still = chosen_tube();
  Preparation preparation(cpu_kernels);
  preparation.follow(still);
  Pose pose;
  for (const double degrees : {20.0, 45.0, 80.0}) {
    const AppState dragged = apply(still, MoveHandle{0, twisted(degrees)});
    pose = follow_to_the_end(preparation, dragged, pose);
    EXPECT_TRUE(pose->last_result.settled);
    EXPECT_LT(largest_distance(positions_at(dragged, *pose), solved(dragged)), kSettled)
        << degrees << " degrees";
  }
}

TEST(Preparation, LiveResultThatIsDoneStaysBitForBit) {
  const AppState dragged = apply(chosen_tube(), MoveHandle{0, bent()});
  Preparation preparation(cpu_kernels);
  preparation.follow(dragged);
  const Pose pose = follow_to_the_end(preparation, dragged);
  const LiveResult again = follow(preparation, dragged, pose);
  EXPECT_TRUE(again.is_done);
  EXPECT_EQ(again.pose->displacement, pose->displacement);
}

// A small move from a pose gives a result close to that pose, even after a large drag in between.
TEST(Preparation, ADragBeginsFromThePoseItIsGiven) {
  const AppState near = apply(chosen_tube(), MoveHandle{0, twisted(80.0)});
  const AppState nearer = apply(near, MoveHandle{0, twisted(81.0)});
  const AppState far = apply(near, MoveHandle{0, twisted(-60.0)});
  Preparation preparation(cpu_kernels);
  preparation.follow(near);
  const Pose at_near = follow_to_the_end(preparation, near);
  follow_to_the_end(preparation, far);
  const LiveResult result = follow(preparation, nearer, at_near);
  EXPECT_LT(largest_distance(positions_at(nearer, *result.pose), positions_at(near, *at_near)),
            0.05);
}

// A second drag of a handle that is turned by more than half a turn already. Pulled, too: a tube
// that is only wound so far buckles, to a side that the frames decide.
TEST(Preparation, LiveResultIsWoundTheWayTheHandleWent) {
  SimilarityMove wound = std::get<SimilarityMove>(twisted(200.0));
  wound.translate = {0.0, 0.0, 1.0};
  const AppState dragged = apply(chosen_tube(), MoveHandle{0, wound});
  Preparation preparation(cpu_kernels);
  preparation.follow(dragged);
  const Pose pose = follow_to_the_end(preparation, dragged);
  EXPECT_LT(largest_distance(positions_at(dragged, *pose), solved(dragged)), kSettled);
}

TEST(Preparation, LiveResultWithoutSettlingOrWithCommitsIsThatOfARun) {
  for (const EditParameters& parameters :
       {EditParameters{{.settle = std::nullopt}}, EditParameters{.commit_every = 60.0}}) {
    AppState state = apply(chosen_tube(), SetParameters{parameters});
    state = apply(state, MoveHandle{0, parameters.settle ? twisted(100.0) : bent()});
    ReadyFor preparation(state);
    const LiveResult result = follow(preparation, state, {});
    EXPECT_TRUE(result.is_done);
    EXPECT_LT(largest_distance(positions_at(state, *result.pose), solved(state)), 1e-12);
  }
}

TEST(Preparation, LiveResultIsNotAskedForWhileAnythingElseIs) {
  const AppState state = apply(chosen_tube(), MoveHandle{0, bent()});
  Preparation preparation(cpu_kernels);
  preparation.follow(state);
  EXPECT_FALSE(preparation.settle_live(state, {})) << "nothing is ready yet";
  preparation.settle(state);
  EXPECT_FALSE(preparation.settle_live(state, {}));
  wait_for(preparation, Phase::ready);
  EXPECT_FALSE(preparation.settle_live(state, {})) << "the result waits to be taken";
  EXPECT_TRUE(preparation.take_result().has_value());
  EXPECT_TRUE(preparation.settle_live(state, {}));
  EXPECT_FALSE(preparation.settle_live(state, {})) << "one after the other";
}

TEST(Preparation, SettlingTakesThePlaceOfALiveResult) {
  AppState state =
      apply(chosen_tube(), SetParameters{{{.settle = SettleOptions{.tolerance = 1e-9}}}});
  ReadyFor preparation(state);
  EXPECT_TRUE(preparation.settle_live(apply(state, MoveHandle{0, twisted(170.0)}), {}));
  state = apply(state, MoveHandle{0, bent()});
  preparation.settle(state);
  EXPECT_EQ(wait_for_result(preparation).moves, state.moves);
  EXPECT_FALSE(preparation.take_live_result().has_value());
}

TEST(Preparation, FailureSaysWhy) {
  Preparation preparation(cpu_kernels);
  preparation.follow(open_state(bumpy_tube()));
  EXPECT_EQ(preparation.status().phase, Phase::idle) << "nothing to prepare";
  preparation.follow(apply(chosen_tube(), Paint{kHandle, {0}, {}}));
  EXPECT_THAT(wait_for(preparation, Phase::failed).message, HasSubstr("extends beyond the ROI"));
  preparation.use_kernels([]() -> std::unique_ptr<Kernels> { throw GpuError("device lost"); });
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
  std::shared_ptr<const DeformSolver> exact;
  std::vector<Eigen::Affine3d> motions;
  {
    Preparation preparation(cpu_kernels);
    const AppState state = apply(chosen_tube(), MoveHandle{0, bent()});
    motions = motions_of(state).maps;
    preparation.follow(state);
    wait_for(preparation, Phase::ready);
    exact = preparation.exact();
  }
  EXPECT_FALSE(lapwing::test::dragged(exact->response(), motions).empty());
}

}  // namespace
}  // namespace lapwing::viewer::test
