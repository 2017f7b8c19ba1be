#pragma once

#include "lapwing/deform/deform.h"
#include "lapwing/deform/deform_request.h"
#include "lapwing/step/operation_words.h"

namespace lapwing {

/// {"op": "deform"}: bends a region by its handles. The step is a DeformRequest.
constexpr OperationWords words_of(const DeformRequest*) {
  return {"deform", "bend a region by its handles"};
}
void describe(DeformRequest& step, KeyVisitor& visitor);
StepReport run_step(const DeformRequest& step, const StepContext& on);

/// Returns the report of a deform, without the step's name. Moves the timings and the DeformReport
/// out of `done`.
StepReport report_of(Deformed& done);

/// Groups of keys that the panels show.
void describe(DeformParameters& parameters, KeyVisitor& visitor);
void describe(SettleOptions& settle, KeyVisitor& visitor);
void describe(LaplacianWeights& weights, KeyVisitor& visitor);

/// Returns whether handles may have a free orientation. That requires settling without substeps and
/// with soft constraints.
bool allows_free_handles(const DeformParameters& parameters);

/// Throws InputError, naming the key and its range, for a number that a recipe may not have.
void require_valid(DeformParameters parameters);
/// Does the same for a handle's move, and for a move that the parameters exclude.
void require_valid(const Move& move, const DeformParameters& parameters);

}  // namespace lapwing
