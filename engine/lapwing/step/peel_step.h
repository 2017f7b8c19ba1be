#pragma once

#include "lapwing/coating/peel.h"
#include "lapwing/step/operation_words.h"

namespace lapwing {

/// Report of a peel step.
struct PeelReport {
  double mean_coating = 0.0;  ///< as in Peeled
  double largest_coating = 0.0;
};

/// {"op": "peel"}: takes the fine detail off a region of the mesh.
constexpr OperationWords words_of(const PeelRequest*) {
  return {"peel", "take the fine detail off a surface"};
}
void describe(PeelRequest& step, KeyVisitor& visitor);
/// Runs `peel` and discards the coating.
StepReport run_step(const PeelRequest& step, const StepContext& on);

}  // namespace lapwing
