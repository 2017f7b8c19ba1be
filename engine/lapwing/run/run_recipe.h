#pragma once

#include <memory>

#include "lapwing/recipe/recipe.h"
#include "lapwing/run/run_step.h"

namespace lapwing {

struct RunOptions {
  /// Fills StepReport::vertices, except for steps that change the triangles.
  bool measure_vertices = false;
  /// Source of the recipe's meshes; null: files only.
  const MeshCache* meshes = nullptr;
};

/// Reads the recipe's mesh, checks it, and runs the steps in order on `kernels`, which must outlive
/// the result. A step with "commit_every", or whose handles rotate by more than 180 degrees without
/// a path, is made in substeps, with all handles together. Writes nothing. Each step ends with a
/// certificate. Throws as `DeformSolver`, `resolve_edit_region` and `read_mesh` do. `progress`
/// receives the stages of reading and of every step.
std::unique_ptr<RunResult> run_recipe(const Recipe& recipe, Kernels& kernels,
                                      const Progress& progress = {},
                                      const RunOptions& options = {});

// The parts of `run_recipe`, for callers that stop after some of the steps. Both throw as
// `run_recipe` does.

/// Takes the recipe's mesh from `meshes` and checks it.
void begin_run(const Recipe& recipe, const MeshCache& meshes, Kernels& kernels,
               const Progress& progress, RunResult& result);

/// Runs the step of `recipe` that follows those in the report of `result`.
void run_next_step(const Recipe& recipe, const MeshCache& meshes, Kernels& kernels,
                   const Progress& progress, RunResult& result);

struct SaveOptions {
  /// Adds the motion of each vertex over the whole run, as vertex properties of a PLY file.
  bool vertex_motion = false;
};

/// Writes the carried files (AttachmentFile), then the mesh. Adds to the report what the formats
/// could not hold, and the time. Throws InputError, and writes nothing, if a format is unknown or
/// if a carried file would replace the result, an input or another carried file. Throws as
/// `write_mesh` does, and InputError for a vertex motion in a format other than PLY.
void save_result(RunResult& result, const std::filesystem::path& path,
                 const SaveOptions& options = {});
/// The same for some of several files, which appear when `files` are committed.
void save_result(RunResult& result, const std::filesystem::path& path, FileReplacements& files,
                 const SaveOptions& options = {});

}  // namespace lapwing
