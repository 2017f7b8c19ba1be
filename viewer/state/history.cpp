#include "state/history.h"

#include <algorithm>
#include <stdexcept>
#include <utility>

namespace lapwing::viewer {

History::History(AppState start) : state_(std::move(start)) {}

void History::perform(const Command& command, Joining joining) {
  if (!can_undo()) joining = Joining::own_step;
  AppState after = apply(joining == Joining::instead_of_last ? before_last() : state_, command);
  const bool is_awaited = std::holds_alternative<Settle>(command) && needs_settling(state_);
  if (is_awaited && can_undo()) {
    take_result(std::move(after));
  } else if (joining == Joining::own_step) {
    record(describe(command), state_, std::move(after));
  } else {
    // The pull belongs to the step of the grab, which keeps its name.
    const std::string grab = describe(Grab{});
    const bool is_pull = joining == Joining::with_last && steps_[done_ - 1].name == grab;
    replace_last(is_pull ? grab : describe(command), std::move(after));
  }
}

void History::record(std::string name, const AppState& before, AppState after) {
  Change change(before, after);
  if (change.is_nothing()) return;
  if (saved_at_ && *saved_at_ > done_) saved_at_.reset();
  steps_.resize(done_);
  steps_.push_back({std::move(name), std::move(change)});
  ++done_;
  state_ = std::move(after);
}

// Replaces the last step by one that leads to `after`. Removes it if `after` changes nothing.
void History::replace_last(std::string name, AppState after) {
  const bool is_saved = saved_at_ == done_ && !Change(state_, after).concerns_surface();
  const AppState before = before_last();
  steps_.resize(--done_);
  state_ = before;
  if (saved_at_ && *saved_at_ > done_) saved_at_.reset();
  record(std::move(name), before, std::move(after));
  if (is_saved) saved_at_ = done_;
}

// Adds the result to the last step. The next undone step then starts from the settled state.
void History::take_result(AppState settled) {
  if (saved_at_ == done_) saved_at_.reset();
  steps_[done_ - 1].change = Change(before_last(), settled);
  if (can_redo()) {
    AppState next = state_;
    steps_[done_].change.redo(next);
    steps_[done_].change = Change(settled, next);
  }
  state_ = std::move(settled);
}

AppState History::before_last() const {
  AppState before = state_;
  steps_[done_ - 1].change.undo(before);
  return before;
}

void History::undo() {
  if (!can_undo()) return;
  steps_[done_ - 1].change.undo(state_);
  --done_;
}

void History::redo() {
  if (!can_redo()) return;
  steps_[done_].change.redo(state_);
  ++done_;
}

void History::go_to(std::size_t steps) {
  if (steps > steps_.size()) throw std::out_of_range("The history has no such step.");
  while (done_ > steps) undo();
  while (done_ < steps) redo();
}

AppState History::last_state(const std::function<bool(const AppState&)>& is_it) const {
  AppState state = state_;
  for (std::size_t k = done_; k > 0 && !is_it(state); --k) steps_[k - 1].change.undo(state);
  return state;
}

std::vector<std::string> History::names() const {
  std::vector<std::string> names;
  for (const Recorded& step : steps_) names.push_back(step.name);
  return names;
}

bool History::unsaved() const {
  if (!saved_at_) return true;
  const auto [first, last] = std::minmax(*saved_at_, done_);
  for (std::size_t k = first; k < last; ++k) {
    if (steps_[k].change.concerns_surface()) return true;
  }
  return false;
}

}  // namespace lapwing::viewer
