#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "state/change.h"
#include "state/command.h"

namespace lapwing::viewer {

/// How a command is added to the history. The first command is always a separate step.
enum class Joining {
  own_step,
  with_last,        ///< becomes part of the last step, for example in a gesture of several commands
  instead_of_last,  ///< replaces the last step, for example while a slider changes a value
};

/// The state and the steps that led to it. Every step can be undone and redone, even after saving.
class History {
 public:
  explicit History(AppState start);

  const AppState& state() const { return state_; }

  /// Carries out `command` as a new step and discards undone steps. A command without effect
  /// neither adds nor discards steps. If the command is `Settle` and the state has no result yet,
  /// the result becomes part of the last step, and undone steps remain. Throws the errors of
  /// `apply`; the history is then unchanged.
  void perform(const Command& command, Joining joining = Joining::own_step);

  bool can_undo() const { return done_ > 0; }
  bool can_redo() const { return done_ < steps_.size(); }
  void undo();  ///< does nothing if no step is done
  void redo();  ///< does nothing if no step is undone
  /// Undoes or redoes steps until `steps` steps are done. Throws std::out_of_range if the history
  /// has fewer steps.
  void go_to(std::size_t steps);

  /// Returns the latest state, not later than the current one, for which `is_it` returns true. If
  /// there is none, returns the first state.
  AppState last_state(const std::function<bool(const AppState&)>& is_it) const;

  /// Returns the names of all steps, the first `done()` of which are done.
  std::vector<std::string> names() const;
  const std::string& name(std::size_t step) const { return steps_[step].name; }
  std::size_t size() const { return steps_.size(); }
  std::size_t done() const { return done_; }

  /// Records that the mesh was saved in its current state.
  void mark_saved() { saved_at_ = done_; }
  /// Records that no state of this history is saved in a file, not even the first state.
  void mark_unsaved() { saved_at_.reset(); }
  /// Returns whether the surface differs from the last saved surface, or from the opened surface if
  /// none was saved.
  bool unsaved() const;

 private:
  struct Recorded {
    std::string name;
    Change change;
  };

  void record(std::string name, const AppState& before, AppState after);
  void replace_last(std::string name, AppState after);
  void take_result(AppState settled);
  AppState before_last() const;

  AppState state_;
  std::vector<Recorded> steps_;
  std::size_t done_ = 0;
  std::optional<std::size_t> saved_at_ = 0;  // steps at the last save; not set if unreachable now
};

}  // namespace lapwing::viewer
