#include "state/history.h"

#include <algorithm>
#include <stdexcept>

namespace lapwing::viewer {

History::History(AppState start) : state_(std::move(start)) {}

void History::perform(const Command& command) {
  AppState after = apply(state_, command);
  Change change(state_, after);
  if (change.is_nothing()) return;
  if (saved_at_ && *saved_at_ > done_) saved_at_.reset();
  steps_.resize(done_);
  steps_.push_back({describe(command), std::move(change)});
  ++done_;
  state_ = std::move(after);
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
  if (steps > steps_.size()) throw std::out_of_range("the history has no such step");
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

std::size_t History::bytes() const {
  std::size_t total = 0;
  for (const Recorded& step : steps_) total += step.name.size() + step.change.bytes();
  return total;
}

}  // namespace lapwing::viewer
