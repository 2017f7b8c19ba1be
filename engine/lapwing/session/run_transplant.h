#pragma once

#include <filesystem>

#include "lapwing/session/run_recipe.h"

namespace lapwing {

/// Carries out `step` on the mesh of `result`, whose mesh, topology and `original` are those of the
/// joined one afterwards: the host's vertices first, in their order. A part's file is looked for in
/// `base_directory`. Adds to the report's warnings. Throws what `run_recipe` does.
StepReport run_step(const TransplantStep& step, const std::filesystem::path& base_directory,
                    Kernels& kernels, const Progress& progress, RunResult& result);

/// The mesh that the part of `step` is or is cut from: the file's, or a copy of `mesh` where the
/// step names none. Throws what `read_mesh` does.
Mesh part_mesh(const TransplantStep& step, const std::filesystem::path& base_directory,
               const Mesh& mesh);

}  // namespace lapwing
