#pragma once

#include <memory>

#include "lapwing/recipe/recipe.h"

namespace lapwing {

struct RunOptions {
  /// Fills in StepReport::vertices, but for steps that changed the triangles.
  bool measure_vertices = false;
  /// Where the recipe's meshes come from; null: from files alone.
  const MeshShelf* meshes = nullptr;
};

/// Takes the recipe's mesh, examines it, and carries the steps out one after the other on
/// `kernels`, which must outlive the result. A step with "commit_every", or whose handles turn by
/// more than 180 degrees without a path, is carried out in parts, all handles together. Writes
/// nothing. Each step ends certified; a step that fails throws what `DeformSolver`,
/// `resolve_edit_region` or `read_mesh` throw, and no result is left. `progress` hears the stages
/// of reading and of every step.
std::unique_ptr<RunResult> run_recipe(const Recipe& recipe, Kernels& kernels,
                                      const Progress& progress = {},
                                      const RunOptions& options = {});

struct SaveOptions {
  /// Writes how each vertex moved in all of the run, as vertex properties of a PLY file.
  bool vertex_motion = false;
};

/// Writes what was carried along (CarriedFile), then the result's mesh, and adds to its report what
/// the formats could not hold, and the time. Nothing is written where a carried file would go over
/// the result, an input or another one, or where a format is unknown: InputError. Throws what
/// `write_mesh` does, and InputError for a vertex motion in another format than PLY.
void save_result(RunResult& result, const std::filesystem::path& path,
                 const SaveOptions& options = {});
/// The same for some of several files: they are in their places once `files` are committed.
void save_result(RunResult& result, const std::filesystem::path& path, FileReplacements& files,
                 const SaveOptions& options = {});

}  // namespace lapwing
