#pragma once

#include "state/draft.h"

namespace lapwing::viewer {

/// An earlier step taken up again: where to start from, and what to carry out from there.
struct Revision {
  AppState start;                            ///< of the history, with nothing moved
  Draft rest;                                ///< what follows, from `start` on
  std::size_t changed = 0;                   ///< the changed step's place among `rest.steps`
  Step step;                                 ///< as it is now
  std::shared_ptr<const Topology> topology;  ///< of the mesh that the open step was chosen on

  /// Whether the changed step is the first to be carried out: then it is changed on `start`.
  bool starts_at_step() const { return changed == 0; }
};

/// `step` in the place of the `index`th step (from 0) of the state that `history` leads to, an open
/// one that is settled counted as the last. Costs memory for no mesh but the one to start from.
/// Throws InputError where there is no such step, or an open one would not be a deform any more.
Revision revision_of(const History& history, std::size_t index, const Step& step);

/// Carries the steps out. What is chosen and not settled stays chosen if its vertices are still
/// there, and is dropped where the triangles came out as others. Throws what `apply` and
/// `carry_out` do, and nothing has changed then.
AppState revised(const Revision& revision, const CarryOut& carry_out);

}  // namespace lapwing::viewer
