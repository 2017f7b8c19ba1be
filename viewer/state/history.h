#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "state/change.h"
#include "state/command.h"

namespace lapwing::viewer {

/// Which step of the history a command is. Where there is no last step it is one of its own.
enum class Joining {
  own_step,
  with_last,        ///< one step with the last: a gesture that takes more than one command
  instead_of_last,  ///< on the state before the last step: a choice that goes on changing
};

/// The state and the way to it: every step can be undone and redone, also after saving. A step
/// costs what it changed.
class History {
 public:
  explicit History(AppState start);

  const AppState& state() const { return state_; }

  /// Carries `command` out; what was undone is forgotten. A command that changes nothing is no
  /// step. A result that the state waits for belongs to the step that asked for it, under that
  /// one's name, and what was undone after that stays. Throws what `apply` does, and nothing has
  /// changed then.
  void perform(const Command& command, Joining joining = Joining::own_step);

  bool can_undo() const { return done_ > 0; }
  bool can_redo() const { return done_ < steps_.size(); }
  void undo();  ///< nothing where it cannot
  void redo();  ///< nothing where it cannot
  /// Undoes or redoes until `steps` are done. Throws std::out_of_range beyond the last step.
  void go_to(std::size_t steps);

  /// The last state on the way to the present one, this included, of which `is_it` holds; the first
  /// where none is.
  AppState last_state(const std::function<bool(const AppState&)>& is_it) const;

  /// Names of all steps, the first `done()` of which are done.
  std::vector<std::string> names() const;
  const std::string& name(std::size_t step) const { return steps_[step].name; }
  std::size_t size() const { return steps_.size(); }
  std::size_t done() const { return done_; }

  /// The mesh was saved as it is now.
  void mark_saved() { saved_at_ = done_; }
  /// No state of this history is what a file holds, not even the first.
  void mark_unsaved() { saved_at_.reset(); }
  /// Whether the surface is another than the one that was saved or, before that, opened.
  bool unsaved() const;

  /// About how much memory the steps hold.
  std::size_t bytes() const;

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
  std::optional<std::size_t> saved_at_ = 0;  // none when that state cannot be reached any more
};

}  // namespace lapwing::viewer
