#include "state/history.h"

#include <random>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "lapwing/base/errors.h"
#include "viewer_state/tube_edit.h"

namespace lapwing::viewer::test {
namespace {

using ::testing::ElementsAre;

History drag_and_settle() {
  History history(chosen_tube());
  history.perform(MoveHandle{0, bent()});
  history.perform(Settle{handles_alone(history.state())});
  return history;
}

// Any command that fits or not; those that do not are refused.
Command random_command(const AppState& state, std::mt19937& random) {
  const auto number = [&](unsigned below) { return static_cast<Index>(random() % below); };
  const auto some = [&] {
    std::vector<Index> vertices(number(6));
    for (Index& v : vertices) v = number(240);
    return make_vertex_set(std::move(vertices));
  };
  const Part part{static_cast<Part::Role>(number(3)), number(3)};
  switch (number(12)) {
    case 0:
      return Choose{part, box(0.1 * number(20), 3.0)};
    case 1:
      return Choose{part, {GeodesicDisk{number(240), 0.1 * (1 + number(9))}}};
    case 2:
    case 3:
      return Paint{part, some(), some()};
    case 4:
      return RemoveHandle{number(3)};
    case 5:
      return SetBeltWidth{0.1 * number(5)};
    case 6:
      return SetParameters{{{.constraint_weight = 1.0 + number(3)}}};
    case 7:
      return Commit{};
    case 10:
      return NewEdit{};
    case 8:
      return MoveHandle{number(2), twisted(10.0 * number(50))};
    case 9:
      return SetFalloff{number(2), {.weight = 1.0 * number(3), .transition = Transition{0.2}}};
    default:
      return Settle{handles_alone(state)};
  }
}

TEST(History, UndoAndRedoOfAnythingLeadBackAndForth) {
  std::mt19937 random(7);
  History history(chosen_tube());
  std::vector<AppState> states{history.state()};
  for (int k = 0; k < 400; ++k) {
    try {
      history.perform(random_command(history.state(), random));
    } catch (const InputError&) {
      EXPECT_TRUE(same(history.state(), states.back())) << "a refused command changed something";
    }
    // A result belongs to the step that asked for it.
    states.resize(history.done());
    states.push_back(history.state());
  }
  ASSERT_GT(states.size(), 150U);
  for (std::size_t k = states.size(); k-- > 0;) {
    history.go_to(k);
    ASSERT_TRUE(same(history.state(), states[k])) << "undone to " << k;
  }
  for (std::size_t k = 0; k < states.size(); ++k) {
    history.go_to(k);
    ASSERT_TRUE(same(history.state(), states[k])) << "redone to " << k;
  }
}

TEST(History, AMoveAndItsResultAreOneStep) {
  History history(chosen_tube());
  const AppState before = history.state();
  history.perform(MoveHandle{0, bent()});
  history.perform(Settle{handles_alone(history.state())});
  const AppState after = history.state();
  history.undo();
  EXPECT_TRUE(same(history.state(), before));
  history.redo();
  EXPECT_TRUE(same(history.state(), after)) << "settled";
  EXPECT_FALSE(history.can_redo());
}

TEST(History, AResultThatComesAfterUndoKeepsWhatWasUndone) {
  History history(chosen_tube());
  history.perform(MoveHandle{0, bent()});
  history.perform(MoveHandle{0, twisted(20.0)});
  history.perform(Settle{handles_alone(history.state())});
  const AppState second = history.state();
  history.undo();
  EXPECT_TRUE(needs_settling(history.state())) << "the second move came before its result";
  history.perform(Settle{handles_alone(history.state())});
  const AppState first = history.state();
  history.redo();
  EXPECT_TRUE(same(history.state(), second));
  history.undo();
  EXPECT_TRUE(same(history.state(), first)) << "and is not asked for again";
}

TEST(History, AHalfStepThatWasSavedIsNotSavedOnceItIsSettled) {
  History history(chosen_tube());
  history.perform(MoveHandle{0, bent()});
  history.mark_saved();
  history.perform(Settle{handles_alone(history.state())});
  EXPECT_TRUE(history.unsaved());
}

TEST(History, AChoiceThatGoesOnChangingIsOneStep) {
  History history(chosen_tube());
  const AppState before = history.state();
  history.perform(Choose{kRoi, {GeodesicDisk{Index{100}, 0.5}}});
  for (const double radius : {0.6, 0.7, 0.2, 0.8}) {
    history.perform(Choose{kRoi, {GeodesicDisk{Index{100}, radius}}}, Joining::instead_of_last);
  }
  EXPECT_EQ(history.done(), 1U);
  EXPECT_TRUE(same(history.state(), apply(before, Choose{kRoi, {GeodesicDisk{Index{100}, 0.8}}})))
      << "as if it had been chosen at once";
  history.undo();
  EXPECT_TRUE(same(history.state(), before));
}

TEST(History, AGestureOfTwoCommandsIsOneStep) {
  History history(chosen_tube());
  const AppState before = history.state();
  history.perform(Choose{kSecondHandle, listed({100})});
  history.perform(MoveHandle{1, bent()}, Joining::with_last);
  history.perform(Settle{handles_alone(history.state())});
  EXPECT_THAT(history.names(), ElementsAre("Move handle 2, rotate 35°"));
  const AppState after = history.state();
  history.undo();
  EXPECT_TRUE(same(history.state(), before));
  history.redo();
  EXPECT_TRUE(same(history.state(), after));
}

TEST(History, APulledGrabIsNamedAGrab) {
  History history(chosen_tube());
  const Mesh mesh = *history.state().rest;
  history.perform(Grab{choose(box(0.6, 4.0), mesh), box(3.0, 4.0), {}});
  history.perform(MoveHandle{0, bent()}, Joining::with_last);
  history.perform(Settle{handles_alone(history.state())});
  EXPECT_THAT(history.names(), ElementsAre("Grab"));
  history.undo();
  history.redo();
  history.perform(MoveHandle{0, twisted(20.0)});
  EXPECT_EQ(history.name(0), "Grab");
}

TEST(History, JoinedStepsKnowWhatWasSaved) {
  History history = drag_and_settle();
  history.perform(Choose{kSecondHandle, listed({100})});
  history.mark_saved();
  history.perform(Choose{kSecondHandle, listed({101})}, Joining::instead_of_last);
  EXPECT_FALSE(history.unsaved()) << "the surface is where it was";
  history.perform(MoveHandle{1, bent()}, Joining::with_last);
  EXPECT_TRUE(history.unsaved());
}

TEST(History, WhatChangesNothingIsNoStep) {
  History history(chosen_tube());
  history.perform(Paint{kRoi, {}, {0}});
  history.perform(SetParameters{});
  history.perform(Commit{});
  EXPECT_FALSE(history.can_undo());
}

TEST(History, UndoSurvivesSaving) {
  History history = drag_and_settle();
  EXPECT_TRUE(history.unsaved());
  history.mark_saved();
  EXPECT_FALSE(history.unsaved());
  history.undo();
  EXPECT_TRUE(history.unsaved());
  history.redo();
  EXPECT_FALSE(history.unsaved());
}

TEST(History, ChoosingVerticesIsNothingToSave) {
  History history(open_state(bumpy_tube()));
  history.perform(Choose{kRoi, box(0.3, 4.0)});
  history.perform(Choose{kHandle, box(2.8, 4.0)});
  EXPECT_FALSE(history.unsaved());
  history.perform(MoveHandle{0, bent()});
  history.perform(Settle{handles_alone(history.state())});
  history.mark_saved();
  history.perform(Choose{kRoi, box(0.6, 4.0)});
  EXPECT_FALSE(history.unsaved()) << "the surface is where it was";
}

TEST(History, ASavedStateThatCannotComeBackIsNotSaved) {
  History history = drag_and_settle();
  history.mark_saved();
  history.undo();
  EXPECT_TRUE(history.can_redo());
  history.perform(MoveHandle{0, twisted(20.0)});
  EXPECT_FALSE(history.can_redo()) << "a new step replaces what was undone";
  history.perform(Settle{handles_alone(history.state())});
  EXPECT_TRUE(history.unsaved());
}

}  // namespace
}  // namespace lapwing::viewer::test
