#pragma once

#include "state/draft.h"

namespace lapwing::viewer {

/// The replacement of an earlier step: a state before this step, and the steps to carry out again.
struct Revision {
  AppState start;                            ///< a state of the history; no handle has moved
  Draft rest;                                ///< the steps after `start`, with the changed step
  std::size_t changed = 0;                   ///< index of the changed step in `rest.steps`
  Step step;                                 ///< the changed step
  std::shared_ptr<const Topology> topology;  ///< of the mesh on which the open step was selected

  /// Returns whether the changed step is the first step to carry out.
  bool starts_at_step() const { return changed == 0; }
};

/// Returns the revision that replaces step `index` (counted from 0) of the current state by `step`.
/// If the open step has settled, it counts as the last step. Throws InputError if there is no step
/// `index`, or if `step` would replace the open deform by another operation.
Revision revision_of(const History& history, std::size_t index, const Step& step);

/// Returns the state after all steps of the revision. The selection of an open step without a
/// result stays if the triangles are the same as before; otherwise it is cleared. Throws the errors
/// of `apply` and `carry_out`.
AppState revised(const Revision& revision, const CarryOut& carry_out);

}  // namespace lapwing::viewer
