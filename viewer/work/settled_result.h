#pragma once

#include <memory>
#include <vector>

#include "lapwing/base/cancellation.h"
#include "lapwing/deform/deform_solver.h"
#include "lapwing/deform/drag.h"
#include "lapwing/kernels/kernels.h"
#include "state/draft.h"
#include "work/attachment_cache.h"

namespace lapwing::viewer {

/// The settled surface for the moves of a state.
struct SettledResult {
  std::vector<HandleMove> moves;               ///< the moves of the requesting state
  std::shared_ptr<const MovedVertices> moved;  ///< includes a certificate
};

/// Computes the result for the moves of `state` with `solver`, which must have been prepared for
/// this state. Starts from the pose `from` if it is a pose of the same region. Otherwise computes
/// the result as a run of the recipe does. Throws the errors of the solver.
SettledResult settled_result(const AppState& state, const DragState* from,
                             const DeformSolver& solver, Kernels& kernels,
                             AttachmentCache& contacts, const Progress& progress);

/// Converts `solved` into a result for `state`, with its certificate and the positions of the
/// carried objects. Throws the errors of AttachmentCache::carry.
std::shared_ptr<const MovedVertices> certified_result(const AppState& state,
                                                      const DeformSolver& solver,
                                                      DeformResult solved,
                                                      AttachmentCache& contacts,
                                                      const Progress& progress);

}  // namespace lapwing::viewer
