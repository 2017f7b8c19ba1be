#include "work/settled_result.h"

#include <optional>
#include <utility>

#include "state/waypoints.h"

namespace lapwing::viewer {
namespace {

// Makes `solved` the result of the state, and carries along what follows the surface.
std::shared_ptr<const MovedVertices> result_of(const AppState& state, const DeformSolver& solver,
                                               DeformResult solved, AttachmentCache& contacts,
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

// The pose in which the surface is at `positions`, the result of the state's moves.
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

// Returns `kept`, bit for bit. Its certificate is that of the minimum found from there.
std::shared_ptr<const MovedVertices> result_again(const AppState& state, const MovedVertices& kept,
                                                  Kernels& kernels, const Progress& progress) {
  Positions positions = state.rest->positions;
  for (std::size_t k = 0; k < kept.vertices.size(); ++k) {
    positions[kept.vertices[k]] = kept.positions[k];
  }
  const DeformSolver solver(state.rest->positions, surface_of(state)->topology(),
                            edit_region(state), state.parameters, kernels, progress);
  DeformResult solved =
      solver.solve_from(pose_at(state, kept, positions), motions_of(state), progress);
  solved.positions = std::move(positions);
  AttachmentCache contacts;
  return result_of(state, solver, std::move(solved), contacts, progress);
}

}  // namespace

// In substeps, each part but the first needs a new preparation.
SettledResult settled_result(const AppState& state, const DragState* from,
                             const DeformSolver& solver, Kernels& kernels,
                             AttachmentCache& contacts, const Progress& progress) {
  if (goes_in_substeps(state.parameters, state.moves)) {
    return {state.moves, solve_open_step(state, kernels, progress)};
  }
  // Any other pose belongs to an earlier selection.
  const bool goes_on = from != nullptr && from->displacement.size() == state.rest->vertex_count() &&
                       from->motions.maps.size() == solver.region().handles.size();
  DeformResult solved = goes_on ? solver.solve_from(*from, motions_of(state), progress)
                                : solver.solve_along(path_of(state), motions_of(state), progress);
  if (const JoinedSurface* joined = joined_seams(state)) joined->close(solved.positions);
  return {state.moves, result_of(state, solver, std::move(solved), contacts, progress)};
}

CarryOut carry_out_again(const InterruptedEdit& edit, Kernels& kernels, Progress progress) {
  CarryOut carry_out = carry_out_with(kernels, progress);
  carry_out.solve = [&edit, &kernels, run = std::move(carry_out.solve),
                     progress = std::move(progress)](const AppState& state) {
    const std::optional<MovedVertices> kept = kept_result(edit, state);
    return kept ? result_again(state, *kept, kernels, progress) : run(state);
  };
  return carry_out;
}

}  // namespace lapwing::viewer
