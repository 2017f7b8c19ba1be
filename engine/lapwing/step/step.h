#pragma once

#include <filesystem>
#include <span>
#include <variant>

#include "lapwing/step/coat_step.h"
#include "lapwing/step/deform_step.h"
#include "lapwing/step/peel_step.h"
#include "lapwing/step/step_context.h"
#include "lapwing/step/transplant_step.h"

namespace lapwing {

/// One operation of a recipe. A new operation is a type here with its `words_of`, `describe` and
/// `run_step`. Recipes, commands, reference and window derive everything from these.
using Step = std::variant<DeformRequest, CoatStep, MixStep, TransplantStep, PeelRequest>;

/// A kind of step.
struct Operation : OperationWords {
  Step step;  ///< with default values
};
/// All operations, in the order of Step.
std::span<const Operation> operations();
const Operation& operation_of(const Step& step);

/// Visits the keys of the step, in the order in which recipes are written.
void describe(Step& step, KeyVisitor& visitor);

/// Runs `step` on the mesh of `on.result`. The same mesh gives the same bits as in `run_recipe`.
/// Adds to the report's warnings. Throws as `run_recipe` does; the result must not be used after
/// that.
StepReport run_step(const Step& step, const StepContext& on);

}  // namespace lapwing
