#pragma once

#include "lapwing/recipe/recipe.h"

namespace lapwing {

// A recipe on its way, for those that need not go all of it. Both throw what `run_recipe` does.

/// Takes the recipe's mesh from `meshes` and examines it.
void begin_run(const Recipe& recipe, const MeshShelf& meshes, Kernels& kernels,
               const Progress& progress, RunResult& result);

/// Carries out the step of `recipe` that comes after those that `result` reports.
void run_next_step(const Recipe& recipe, const MeshShelf& meshes, Kernels& kernels,
                   const Progress& progress, RunResult& result);

}  // namespace lapwing
