#include "editing/action_queue.h"

#include <utility>

namespace lapwing::viewer {
namespace {

bool is_of_roi(const Command& command) {
  const auto is_roi = [](const auto* choice) {
    return choice != nullptr && choice->part.role == Part::Role::roi;
  };
  return is_roi(std::get_if<Choose>(&command)) || is_roi(std::get_if<Paint>(&command));
}

}  // namespace

bool commits(const Command& command) {
  return is_one_of<Choose, Paint, Grab, RemoveHandle, Commit, NewEdit>(command);
}

ActionQueue::ActionQueue(EditSession& session, const ActiveTool& active, SurfaceView& view,
                         LiveDrag& drag, Say say, std::function<void(bool)> changed)
    : session_(session),
      active_(active),
      view_(view),
      drag_(drag),
      say_(std::move(say)),
      changed_(std::move(changed)) {}

bool ActionQueue::attempt(const std::function<void()>& change) {
  const bool carried_out = session_.is_carrying_out();
  const bool is_done = say_errors(say_, [&] {
    change();
    view_.point_at({});
    if (!session_.warning().empty()) say_({session_.warning(), Tone::warning});
    if (carried_out && !session_.is_carrying_out()) {
      say_("The step was cancelled because the surface has changed. Apply it again.");
    }
  });
  if (is_done) say_({"", Tone::error});  // clears an error that no longer applies
  changed_(false);
  return is_done;
}

bool ActionQueue::perform(const Command& command, Joining joining) {
  if (waits() && commits(command)) {
    postpone([this, command, joining] { perform(command, joining); });
    return false;
  }
  resizable_at_.reset();
  drag_.hold_pose();
  const std::size_t handles = state().selection.handles.size();
  const bool moves_on = std::holds_alternative<MoveHandle>(command);
  const bool is_done = attempt(
      [&] { session_.perform(command, joining, moves_on ? view_.shown().pose() : nullptr); });
  if (is_done && is_of_roi(command)) say_what_was_let_go(handles);
  if (const auto* mirror = std::get_if<SetMirror>(&command); is_done && mirror != nullptr) {
    say_(mirror->plane ? "Mirror on" : "Mirror off");
  }
  return is_done;
}

bool ActionQueue::perform_choice(const Command& command, Joining joining, bool resizes,
                                 bool may_resize) {
  const std::size_t done = session_.history().done();
  const bool replaces = resizes && resizable_at_ == done;
  const bool is_done = perform(command, replaces ? Joining::instead_of_last : joining);
  const std::size_t expected = replaces || joining == Joining::with_last ? done : done + 1;
  if (is_done && session_.history().done() == expected && (may_resize || resizes)) {
    resizable_at_ = expected;
  }
  return is_done;
}

void ActionQueue::say_what_was_let_go(std::size_t handles_before) {
  const std::size_t handles = state().selection.handles.size();
  if (handles >= handles_before) return;
  say_(handles == 0 ? kBeginsNewEdit
                    : "Handles outside the region were removed. Undo restores them.");
}

// A state without a result looks the same for every path through the history that leads to it.
void ActionQueue::step_through_history(const std::function<void()>& change) {
  if (active_.is_dragging()) return;
  give_up_postponed();
  view_.shown().follow_from(nullptr);
  say_("");  // the last message is about the previous position in the history
  attempt(change);
}

// The postponed actions are the latest, so undo discards them first.
void ActionQueue::undo() {
  if (has_postponed() && !active_.is_dragging()) {
    give_up_postponed();
    return say_("");
  }
  step_through_history([&] { session_.undo(); });
}

void ActionQueue::redo() {
  step_through_history([&] { session_.redo(); });
}

void ActionQueue::go_to(std::size_t steps) {
  step_through_history([&] { session_.go_to(steps); });
}

void ActionQueue::continue_with(History history) {
  step_through_history([&] { session_.continue_with(std::move(history)); });
}

// The view keeps showing the same surface, such as a preview of the step, until the result is
// ready.
void ActionQueue::carry_out(const Step& step) {
  say_errors(say_, [&] { session_.carry_out(step); });
}

void ActionQueue::replace_step(std::size_t index, const Step& step) {
  say_errors(say_, [&] { session_.replace_step(index, step); });
}

void ActionQueue::carry_along(const std::vector<std::filesystem::path>& files) {
  say_errors(say_, [&] { session_.carry_along(files); });
}

void ActionQueue::postpone(std::function<void()> act) {
  if (postponed_.empty())
    say_("This action starts when the last edit is refined. Undo cancels it.");
  postponed_.push_back(std::move(act));
}

void ActionQueue::run_postponed() {
  if (postponed_.empty() || session_.awaits_result()) return;
  holds_press_ = false;
  say_("");
  const auto acts = std::exchange(postponed_, {});
  for (const auto& act : acts) act();
}

void ActionQueue::give_up_postponed() {
  postponed_.clear();
  holds_press_ = false;
}

void ActionQueue::take_results() {
  if (session_.take_result()) changed_(true);
  if (!active_.is_dragging()) run_postponed();
  // A step must not change the surface under a stroke.
  if (!active_.is_dragging()) take_step();
}

void ActionQueue::take_step() {
  std::optional<StepTaken> taken;
  const EditSelection& selection = state().selection;
  const bool had_chosen = !selection.roi.vertices.empty() || !selection.handles.empty();
  const std::size_t steps_before = state().steps.size();
  say_errors(say_, [&] { taken = session_.take_step(); });
  if (!taken) return;
  view_.point_at({});
  // If an earlier step was replaced, the warnings may be about any of the steps after it.
  const bool is_new = state().steps.size() > steps_before;
  for (const std::string& warning : taken->warnings) {
    say_({warning, Tone::warning, is_new ? state().steps.back() : nullptr});
  }
  if (taken->changed_triangles && had_chosen) {
    say_("The triangles have changed. Select the region again.");
  }
  changed_(false);
}

}  // namespace lapwing::viewer
