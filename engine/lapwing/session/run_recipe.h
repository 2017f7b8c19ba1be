#pragma once

#include <memory>

#include "lapwing/deform/deform.h"
#include "lapwing/recipe/recipe.h"
#include "lapwing/session/report.h"

namespace lapwing {

/// What running a recipe leaves behind.
struct RunResult {
  Mesh mesh;  ///< with the edited positions
  /// The positions that were read, per vertex of `mesh`; a vertex that a coat or mix step's
  /// remeshing made is where it was made.
  Positions original;
  /// What the last step leaves if that is a deform; empty after any other.
  DeformWorkspace deformed;
  /// What the last step concerned; nothing without steps.
  EditRegion region;
  RunReport report;
};

struct RunOptions {
  /// Fills in StepReport::vertices, but for steps that changed the triangles.
  bool measure_vertices = false;
};

/// Reads the recipe's mesh, examines it, and carries the steps out one after the other on
/// `kernels`, which must outlive the result. A step with "commit_every" is carried out in parts,
/// all handles together; one that turns a handle too far without it is warned about. Writes
/// nothing. Each step ends certified; a step that fails throws what `Deformer`,
/// `resolve_edit_region` or `read_mesh` throw, and no result is left. `progress` hears the stages
/// of reading and of every step.
std::unique_ptr<RunResult> run_recipe(const Recipe& recipe, Kernels& kernels,
                                      const Progress& progress = {},
                                      const RunOptions& options = {});

/// Carries out one step, the `number`th of its recipe (from 1), on the mesh of `result`, as
/// `run_recipe` does: the same bits from the same mesh. Sources are looked for in `base_directory`.
/// Adds to the report's warnings. Throws what `run_recipe` does, and then `result` must not be used
/// any more.
StepReport run_step(const Step& step, std::size_t number,
                    const std::filesystem::path& base_directory, Kernels& kernels,
                    const Progress& progress, RunResult& result);

/// Writes the result's mesh and adds to its report what the format could not carry, and the time.
void save_result(RunResult& result, const std::filesystem::path& path);

}  // namespace lapwing
