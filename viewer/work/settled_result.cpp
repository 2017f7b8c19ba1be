#include "work/settled_result.h"

#include <utility>

#include "state/waypoints.h"

namespace lapwing::viewer {

std::shared_ptr<const MovedVertices> certified_result(const AppState& state,
                                                      const DeformSolver& solver,
                                                      DeformResult solved,
                                                      AttachmentCache& contacts,
                                                      const Progress& progress) {
  const JoinedSurface* joined = joined_seams(state);
  MovedVertices moved = moved_vertices(state.rest->positions, solved.positions);
  if (any_follows(state.carried)) {
    const Deformed deformed =
        deformed_of(*state.rest, joined, solver.region(), std::move(solved.positions),
                    std::move(solved.rest_stretch));
    moved.carried =
        files_of(state.carried, contacts.carry(state.carried, state.rest, deformed, progress));
  }
  moved.certificate = std::make_shared<const Certificate>(std::move(solved.certificate));
  return std::make_shared<const MovedVertices>(std::move(moved));
}

// Substeps do not use `solver`, because each later substep needs a separate preparation.
SettledResult settled_result(const AppState& state, const DragState* from,
                             const DeformSolver& solver, Kernels& kernels,
                             AttachmentCache& contacts, const Progress& progress) {
  if (uses_substeps(state.parameters, state.moves)) {
    return {state.moves, solve_open_step(state, kernels, progress)};
  }
  // Use `from` only if it is a pose of the current selection.
  const bool goes_on = from != nullptr && from->displacement.size() == state.rest->vertex_count() &&
                       from->motions.maps.size() == solver.region().handles.size();
  DeformResult solved = goes_on ? solver.solve_from(*from, motions_of(state), progress)
                                : solver.solve_along(path_of(state), motions_of(state), progress);
  if (const JoinedSurface* joined = joined_seams(state)) joined->close(solved.positions);
  return {state.moves, certified_result(state, solver, std::move(solved), contacts, progress)};
}

}  // namespace lapwing::viewer
