#pragma once

#include "lapwing/recipe/recipe.h"

namespace lapwing {

// The parts of `run_recipe`, for callers that stop after some of the steps. Both throw as
// `run_recipe` does.

/// Takes the recipe's mesh from `meshes` and checks it.
void begin_run(const Recipe& recipe, const MeshCache& meshes, Kernels& kernels,
               const Progress& progress, RunResult& result);

/// Runs the step of `recipe` that follows those in the report of `result`.
void run_next_step(const Recipe& recipe, const MeshCache& meshes, Kernels& kernels,
                   const Progress& progress, RunResult& result);

}  // namespace lapwing
