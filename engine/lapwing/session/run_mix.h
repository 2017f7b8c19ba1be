#pragma once

#include <filesystem>

#include "lapwing/session/run_recipe.h"

namespace lapwing {

/// Carries out `step` on the mesh of `result`; sources are looked for in `base_directory`. Where
/// the patch has to be remeshed, mesh, topology and `original` of `result` are those of the finer
/// mesh afterwards. Adds to the report's warnings. Throws what `run_recipe` does.
StepReport run_step(const MixStep& step, const std::filesystem::path& base_directory,
                    Kernels& kernels, const Progress& progress, RunResult& result);

}  // namespace lapwing
