#pragma once

#include <filesystem>
#include <optional>

#include "lapwing/session/run_recipe.h"

namespace lapwing {

/// Carries out `step` on the mesh of `result`, whose mesh, topology and `original` are those of the
/// joined one afterwards: the host's vertices first, in their order. A part's file is looked for in
/// `base_directory`. Adds to the report's warnings. Throws what `run_recipe` does.
StepReport run_step(const TransplantStep& step, const std::filesystem::path& base_directory,
                    Kernels& kernels, const Progress& progress, RunResult& result);

/// The mesh that the part of `step` is or is cut from; none where that is the mesh itself. Throws
/// what `read_mesh` does.
std::optional<Mesh> read_part_mesh(const TransplantStep& step,
                                   const std::filesystem::path& base_directory);

}  // namespace lapwing
