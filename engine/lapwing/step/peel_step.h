#pragma once

#include "lapwing/coating/peel.h"
#include "lapwing/step/operation_words.h"

namespace lapwing {

/// What a peel did.
struct PeelReport {
  double mean_coating = 0.0;  ///< of what came off: as in Peeled
  double largest_coating = 0.0;
};

/// {"op": "peel"}: take the fine detail off a region of the mesh.
constexpr OperationWords words_of(const PeelRequest*) {
  return {"peel", "take the fine detail off a surface"};
}
void describe(PeelRequest& step, KeyVisitor& visitor);
/// Carries it out: `peel`, with nothing of what came off kept.
StepReport run_step(const PeelRequest& step, const StepRun& on);

}  // namespace lapwing
