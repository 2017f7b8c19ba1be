#include "work/crash_recovery.h"

#include <optional>
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

// Returns a history that contains the undone steps, too. Returns nullopt if these steps fail or if
// the current draft is not on the way to them.
std::optional<History> with_undone_steps(const AppState& start, const InterruptedEdit& edit,
                                         const CarryOut& carry_out) {
  try {
    History history = from_draft(start, *edit.undone, carry_out);
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
  if (edit.undone) {
    if (auto history = with_undone_steps(start, edit, carry_out)) return std::move(*history);
  }
  return from_draft(std::move(start), edit.draft, carry_out);
}

}  // namespace lapwing::viewer
