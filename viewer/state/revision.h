#pragma once

#include "state/draft.h"

namespace lapwing::viewer {

/// An earlier step that is edited again: where to start, and what to carry out from there.
struct Revision {
  AppState start;                            ///< a state of the history, with nothing moved
  Draft rest;                                ///< the steps after `start`
  std::size_t changed = 0;                   ///< index of the changed step in `rest.steps`
  Step step;                                 ///< the changed step
  std::shared_ptr<const Topology> topology;  ///< of the mesh on which the open step was chosen

  /// Returns whether the changed step is the first one to carry out, on `start` itself.
  bool starts_at_step() const { return changed == 0; }
};

/// Returns the revision that replaces step `index` (from 0) of the history's state with `step`. If
/// the open step has settled, it counts as the last step. Throws InputError if there is no step
/// `index`, or if `step` would replace the open deform by another operation.
Revision revision_of(const History& history, std::size_t index, const Step& step);

/// Carries out the steps. A selection that is not settled stays if its vertices still exist, and is
/// dropped if the triangles have changed. Throws what `apply` and `carry_out` throw, without any
/// change.
AppState revised(const Revision& revision, const CarryOut& carry_out);

}  // namespace lapwing::viewer
