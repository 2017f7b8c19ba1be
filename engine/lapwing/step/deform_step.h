#pragma once

#include "lapwing/deform/deform.h"
#include "lapwing/deform/deform_request.h"
#include "lapwing/step/operation_words.h"

namespace lapwing {

/// {"op": "deform"}: bend a region by its handles. The step is a DeformRequest.
constexpr OperationWords words_of(const DeformRequest*) {
  return {"deform", "bend a region by its handles"};
}
void describe(DeformRequest& step, KeyVisitor& visitor);
StepReport run_step(const DeformRequest& step, const StepRun& on);

/// What a deform has to say of itself as a step, but for the step's name; of `done` its timings and
/// its DeformReport are taken.
StepReport report_of(Deformed& done);

/// The keys of parts of it, which panels show.
void describe(DeformParameters& parameters, KeyVisitor& visitor);
void describe(SettleOptions& settle, KeyVisitor& visitor);
void describe(LaplacianWeights& weights, KeyVisitor& visitor);

/// Whether handles may have a free orientation: the surface settles, at once, with soft
/// constraints.
bool allows_free_handles(const DeformParameters& parameters);

/// Throws InputError, naming the key and what it takes, for a number that a recipe would refuse.
void require_valid(DeformParameters parameters);
/// Likewise of a handle's move, or for one that does not go with the parameters.
void require_valid(const Move& move, const DeformParameters& parameters);

}  // namespace lapwing
