#pragma once

#include <filesystem>
#include <span>

#include "lapwing/coating/prepared_coat.h"
#include "lapwing/session/run_recipe.h"

namespace lapwing {

/// Carries out `step` on the mesh of `result`; a source is looked for in `base_directory`. Where
/// the patch has to be remeshed, mesh, topology and `original` of `result` are those of the finer
/// mesh afterwards. Adds to the report's warnings. Throws what `run_recipe` does.
StepReport run_step(const CoatStep& step, const std::filesystem::path& base_directory,
                    Kernels& kernels, const Progress& progress, RunResult& result);

/// The meshes of `sources`, null for one without a file; looked for in `base_directory`. Throws
/// what `read_mesh` does.
std::vector<SharedSource> read_source_meshes(std::span<const FileSource> sources,
                                             const std::filesystem::path& base_directory);

/// Leaves what `coat` came to at `positions` in `result`: mesh, region and warnings. Returns the
/// report of that step, called `op`; `source_timings` are those of what went before.
StepReport take_over(const LayeredCoat& coat, const std::string& op, StageTimings source_timings,
                     Positions positions, RunResult& result);

}  // namespace lapwing
