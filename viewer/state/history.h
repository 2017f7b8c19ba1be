#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "state/change.h"
#include "state/command.h"

namespace lapwing::viewer {

/// How a command joins the history. The first command is always a separate step.
enum class Joining {
  own_step,
  with_last,        ///< part of the last step: a gesture of several commands
  instead_of_last,  ///< replaces the last step: a choice that keeps changing
};

/// The state and the steps that led to it. Every step can be undone and redone, also after saving.
class History {
 public:
  explicit History(AppState start);

  const AppState& state() const { return state_; }

  /// Carries out `command` as a new step and discards undone steps. A command without effect adds
  /// no step and discards none. If the command is the result for which the state waits, the result
  /// becomes part of the last step, and undone steps remain. Throws what `apply` throws; the
  /// history is then unchanged.
  void perform(const Command& command, Joining joining = Joining::own_step);

  bool can_undo() const { return done_ > 0; }
  bool can_redo() const { return done_ < steps_.size(); }
  void undo();  ///< does nothing if no step is done
  void redo();  ///< does nothing if no step is undone
  /// Undoes or redoes until `steps` are done. Throws std::out_of_range beyond the last step.
  void go_to(std::size_t steps);

  /// Returns the last state, up to the present one, for which `is_it` holds, or the first state if
  /// there is none.
  AppState last_state(const std::function<bool(const AppState&)>& is_it) const;

  /// Returns the names of all steps, the first `done()` of which are done.
  std::vector<std::string> names() const;
  const std::string& name(std::size_t step) const { return steps_[step].name; }
  std::size_t size() const { return steps_.size(); }
  std::size_t done() const { return done_; }

  /// Records that the mesh was saved in its present state.
  void mark_saved() { saved_at_ = done_; }
  /// Records that no file holds a state of this history, not even the first.
  void mark_unsaved() { saved_at_.reset(); }
  /// Returns whether the surface differs from the one saved last or, before that, opened.
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
  std::optional<std::size_t> saved_at_ = 0;  // not set if that state cannot be reached any more
};

}  // namespace lapwing::viewer
