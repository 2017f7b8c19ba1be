#pragma once

#include <filesystem>
#include <span>
#include <variant>

#include "lapwing/step/coat_step.h"
#include "lapwing/step/deform_step.h"
#include "lapwing/step/peel_step.h"
#include "lapwing/step/step_run.h"
#include "lapwing/step/transplant_step.h"

namespace lapwing {

/// One operation of a recipe. A new one is a type here with its `words_of`, `describe` and
/// `run_step`: recipes, commands, reference and window take it from there.
using Step = std::variant<DeformRequest, CoatStep, MixStep, TransplantStep, PeelRequest>;

/// One kind of step.
struct Operation : OperationWords {
  Step step;  ///< with every default
};
/// All of them, in the order of Step.
std::span<const Operation> operations();
const Operation& operation_of(const Step& step);

/// The keys of whichever step it is, in the order in which recipes are written.
void describe(Step& step, KeyVisitor& visitor);

/// Carries `step` out on the mesh of `on.result`, as `run_recipe` does: the same bits from the same
/// mesh. Adds to the report's warnings. Throws what `run_recipe` does, and then the result must not
/// be used any more.
StepReport run_step(const Step& step, const StepRun& on);

}  // namespace lapwing
