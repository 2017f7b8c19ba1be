#pragma once

#include "lapwing/session/run_recipe.h"

namespace lapwing {

/// Carries out `step`, the `number`th of its recipe (from 1), on the mesh of `result`, leaves its
/// deformer in `last`, and adds to the report's warnings. Throws what `run_recipe` does.
StepReport run_step(const DeformRequest& step, std::size_t number, Kernels& kernels,
                    const Progress& progress, RunResult& result);

}  // namespace lapwing
