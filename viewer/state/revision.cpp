#include "state/revision.h"

#include <algorithm>

#include "lapwing/base/errors.h"

namespace lapwing::viewer {
namespace {

// Returns the steps that lead to the surface of `state`, including the open step if it has moved.
std::vector<Step> steps_to(const AppState& state) {
  std::vector<Step> steps;
  for (const auto& step : state.steps) steps.push_back(*step);
  if (is_moved(state)) steps.emplace_back(open_step(state));
  return steps;
}

// Returns whether `state` is the result of the first k steps of `steps`, for some k <= `most`.
bool leads_to(const AppState& state, const std::vector<Step>& steps, std::size_t most) {
  if (needs_settling(state) || state.steps.size() > most) return false;
  const std::vector<Step> done = steps_to(state);
  return done.size() <= most && std::equal(done.begin(), done.end(), steps.begin());
}

DeformRequest as_open(const Step& step) {
  const auto* deform = std::get_if<DeformRequest>(&step);
  if (deform != nullptr && is_selection(*deform)) return *deform;
  throw InputError(
      "A deform step can only be replaced by a deform step that gives no target positions. Undo "
      "it, then apply the new step.");
}

}  // namespace

Revision revision_of(const History& history, std::size_t index, const Step& step) {
  Draft draft = draft_of(history.state());
  const std::size_t count = draft.steps.size() + (draft.settled ? 1 : 0);
  if (index >= count) {
    throw InputError("There is no step " + std::to_string(index + 1) + " to change, only " +
                     std::to_string(count));
  }
  const auto is_before = [&](const AppState& state) { return leads_to(state, draft.steps, index); };
  AppState start = apply(history.last_state(is_before), Commit{});
  const std::size_t done = start.steps.size();
  if (index < draft.steps.size()) {
    draft.steps[index] = step;
  } else {
    draft.open = as_open(step);
  }
  draft.steps.erase(draft.steps.begin(), draft.steps.begin() + static_cast<std::ptrdiff_t>(done));
  return {std::move(start), std::move(draft), index - done, step,
          history.state().rest->shared_topology()};
}

AppState revised(const Revision& revision, const CarryOut& carry_out) {
  const Draft& rest = revision.rest;
  History history(revision.start);
  for (const Step& step : rest.steps) perform(history, step, carry_out);
  const bool same_triangles =
      history.state().rest->topology().triangles == revision.topology->triangles;
  if (rest.settled || same_triangles) {
    perform(history, rest.open, rest.settled ? carry_out.solve : Solve{});
  } else {
    history.perform(Commit{});
    carry_along(history, rest.open.carry);
  }
  return history.state();
}

}  // namespace lapwing::viewer
