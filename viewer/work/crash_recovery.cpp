#include "work/crash_recovery.h"

#include <algorithm>
#include <optional>
#include <span>
#include <utility>

#include "lapwing/base/errors.h"
#include "work/settled_result.h"

namespace lapwing::viewer {
namespace {

// Returns the pose of a drag that has reached the moves of `state`. `positions` contains the
// positions in `moved`, and the rest positions of all other vertices.
DragState pose_at(AppState state, const MovedVertices& moved, const Positions& positions) {
  state.settled = std::make_shared<const MovedVertices>(moved);
  DragState pose;
  pose.motions = motions_of(state);
  pose.displacement = positions;
  for (std::size_t v = 0; v < positions.size(); ++v) {
    pose.displacement[v] -= state.rest->positions[v];
  }
  return pose;
}

// Returns a result with exactly the positions of `kept`. Its certificate belongs to the minimum
// that the solver finds from these positions.
std::shared_ptr<const MovedVertices> result_again(const AppState& state, const MovedVertices& kept,
                                                  Kernels& kernels, const Progress& progress) {
  Positions positions = state.rest->positions;
  place(kept, positions);
  const DeformSolver solver(state.rest->positions, surface_of(state)->topology(),
                            edit_region(state), state.parameters, kernels, progress);
  DeformResult solved =
      solver.solve_from(pose_at(state, kept, positions), motions_of(state), progress);
  solved.positions = std::move(positions);
  AttachmentCache contacts;
  return certified_result(state, solver, std::move(solved), contacts, progress);
}

// Returns whether the steps differ at most in the moves of their handles.
bool moves_same_handles(DeformRequest a, const DeformRequest& b) {
  if (a.handles.size() != b.handles.size()) return false;
  for (std::size_t h = 0; h < a.handles.size(); ++h) {
    a.handles[h].move = b.handles[h].move;
    a.handles[h].orientation = b.handles[h].orientation;
    a.handles[h].path = b.handles[h].path;
  }
  return a == b;
}

// Performs the later moves and steps of the draft `undone`. Returns false if the draft does not
// begin with the committed steps of the history.
bool go_on_to(History& history, const Draft& undone, const CarryOut& carry_out) {
  const Draft now = draft_of(history.state());
  const std::size_t common = now.steps.size();
  if (common > undone.steps.size() ||
      !std::ranges::equal(now.steps, std::span(undone.steps).first(common))) {
    return false;
  }
  const bool is_open = common == undone.steps.size();
  const auto* next = is_open ? &undone.open : std::get_if<DeformRequest>(&undone.steps[common]);
  if (next == nullptr || !moves_same_handles(now.open, *next)) return false;
  std::vector<HandleMove> moves;
  for (const MovedHandle& handle : next->handles) {
    moves.emplace_back(handle.move, handle.orientation, handle.path);
  }
  history.perform(MoveHandles{std::move(moves)});
  if (needs_settling(history.state()) && (!is_open || undone.settled)) {
    history.perform(Settle{carry_out.solve(history.state())});
  }
  if (!is_open) {
    for (std::size_t k = common + 1; k < undone.steps.size(); ++k) {
      perform(history, undone.steps[k], carry_out);
    }
    perform(history, undone.open, undone.settled ? carry_out.solve : Solve{});
  }
  return true;
}

// Returns a history that contains the undone steps, too. Returns nullopt if these steps fail or if
// the current draft is not on the way to them.
std::optional<History> with_undone_steps(const AppState& start, const InterruptedEdit& edit,
                                         const CarryOut& carry_out) {
  try {
    History history = from_draft(start, edit.draft, carry_out);
    const std::size_t done = history.done();
    const bool is_whole = std::ranges::all_of(edit.undone, [&](const Draft& undone) {
      return is_begun_grab(undone.open) || go_on_to(history, undone, carry_out);
    });
    history.go_to(done);
    if (is_whole) return history;
    // The undone changes include settings other than moves. The last draft contains these settings,
    // but only the last move of each handle.
    history = from_draft(start, edit.undone.back(), carry_out);
    while (history.can_undo()) {
      history.undo();
      if (draft_of(history.state()) == edit.draft) return history;
    }
  } catch (const Cancelled&) {
    throw;
  } catch (const Error&) {
    // The current draft can still be restored.
  }
  return std::nullopt;
}

}  // namespace

History restore_after_crash(AppState start, const InterruptedEdit& edit, Kernels& kernels,
                            const Progress& progress) {
  CarryOut carry_out = carry_out_with(kernels, progress);
  carry_out.solve = [&, run = std::move(carry_out.solve)](const AppState& state) {
    const std::optional<MovedVertices> kept = kept_result(edit, state);
    return kept ? result_again(state, *kept, kernels, progress) : run(state);
  };
  if (!edit.undone.empty()) {
    if (auto history = with_undone_steps(start, edit, carry_out)) return std::move(*history);
  }
  return from_draft(std::move(start), edit.draft, carry_out);
}

}  // namespace lapwing::viewer
