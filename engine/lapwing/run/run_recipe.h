#pragma once

#include <memory>

#include "lapwing/recipe/recipe.h"
#include "lapwing/run/run_step.h"

namespace lapwing {

struct RunOptions {
  /// Fills StepReport::vertices, except for steps that change the triangles.
  bool measure_vertices = false;
  /// Source of the recipe's meshes. If null, all meshes are read from files.
  const MeshCache* meshes = nullptr;
};

/// Reads the recipe's mesh, checks it, and runs the steps in order on `kernels`, which must outlive
/// the result. A step is divided into substeps, the same for all handles, if it has "commit_every"
/// or if a handle rotates by more than 180 degrees without a path. Writes no files. Each deform
/// step ends with a certificate. Throws as `DeformSolver`, `resolve_edit_region` and `read_mesh`
/// do. `progress` receives the stages of reading and of every step.
std::unique_ptr<RunResult> run_recipe(const Recipe& recipe, Kernels& kernels,
                                      const Progress& progress = {},
                                      const RunOptions& options = {});

// The parts of `run_recipe`, for callers that stop after some of the steps. Both functions throw as
// `run_recipe` does.

/// Gets the recipe's mesh from `meshes` and checks it.
void begin_run(const Recipe& recipe, const MeshCache& meshes, Kernels& kernels,
               const Progress& progress, RunResult& result);

/// Runs the step of `recipe` that follows the steps in the report of `result`.
void run_next_step(const Recipe& recipe, const MeshCache& meshes, Kernels& kernels,
                   const Progress& progress, RunResult& result);

struct SaveOptions {
  /// Adds the motion of each vertex over the whole run, as vertex properties of a PLY file.
  bool vertex_motion = false;
};

/// Writes the attachment files (AttachmentFile), then the mesh. Adds the time, and warnings about
/// data that the formats cannot store, to the report. Throws InputError, and writes nothing, if a
/// format is unknown or if an attachment file would replace the result, an input or another
/// attachment file. Throws as `write_mesh` does, and InputError for `vertex_motion` in a format
/// other than PLY.
void save_result(RunResult& result, const std::filesystem::path& path,
                 const SaveOptions& options = {});
/// Saves the result as part of a set of files, which all appear when `files` is committed.
void save_result(RunResult& result, const std::filesystem::path& path, FileReplacements& files,
                 const SaveOptions& options = {});

}  // namespace lapwing
