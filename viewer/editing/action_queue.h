#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <vector>

#include "editing/live_drag.h"

namespace lapwing::viewer {

/// Returns whether the command makes the settled surface the rest shape first (`apply`).
bool commits(const Command& command);

/// The message that a selection has begun another edit.
inline constexpr const char* kBeginsNewEdit = "New edit. Undo returns to the previous one.";

/// Carries out the user's actions in order and makes them undoable. Actions that need the result of
/// the last edit are postponed until it has settled. An action that fails reports its error to
/// `say` and changes nothing.
class ActionQueue {
 public:
  /// `changed` is called after each change of the state. Its argument is true if the change is a
  /// result of the background thread.
  ActionQueue(EditSession& session, const ActiveTool& active, SurfaceView& view, LiveDrag& drag,
              Say say, std::function<void(bool by_result)> changed);

  /// Carries out the command and returns whether it succeeded. If `commits(command)` is true, the
  /// last edit must settle first, so the command is postponed until then.
  bool perform(const Command& command, Joining joining = Joining::own_step);
  /// Performs the choice of a tool. If the tool `may_resize` it later, a call with `resizes`
  /// replaces the choice, unless another command was performed in between.
  bool perform_choice(const Command& command, Joining joining, bool resizes, bool may_resize);
  void undo();
  void redo();
  void go_to(std::size_t steps);
  void continue_with(History history);
  /// Carries out a whole step in the background (EditSession). `take_results` takes its result.
  void carry_out(const Step& step);
  void replace_step(std::size_t index, const Step& step);
  /// Does the same with files that follow the surface from the open step on.
  void carry_along(const std::vector<std::filesystem::path>& files);

  /// Returns true while the last edit is settling, or while postponed actions wait for it.
  bool waits() const { return session_.awaits_result() || has_postponed(); }
  bool has_postponed() const { return !postponed_.empty(); }
  /// Runs `act` once the edit has settled, after all actions that were postponed earlier. While
  /// actions are postponed, `undo` only discards them. `redo` and `go_to` discard them and then
  /// change the state.
  void postpone(std::function<void()> act);
  /// Whether the button of a postponed press is still down. Its release is then postponed, too.
  bool holds_press() const { return holds_press_; }
  void set_holds_press(bool holds) { holds_press_ = holds; }

  /// Takes the results of the background threads, and runs postponed actions if nothing is being
  /// dragged. Call this once per frame.
  void take_results();

 private:
  const AppState& state() const { return session_.state(); }
  bool attempt(const std::function<void()>& change);
  void step_through_history(const std::function<void()>& change);
  void say_what_was_let_go(std::size_t handles_before);
  void run_postponed();
  void give_up_postponed();
  void take_step();

  EditSession& session_;
  const ActiveTool& active_;
  SurfaceView& view_;
  LiveDrag& drag_;
  Say say_;
  std::function<void(bool)> changed_;
  std::vector<std::function<void()>> postponed_;  // to run once the edit has settled, in order
  bool holds_press_ = false;
  // `done()` of the history after a choice that a tool may still resize.
  std::optional<std::size_t> resizable_at_;
};

}  // namespace lapwing::viewer
