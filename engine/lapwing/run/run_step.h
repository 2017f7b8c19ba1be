#pragma once

#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "lapwing/base/cancellation.h"
#include "lapwing/coating/layered_coat.h"
#include "lapwing/deform/deform.h"
#include "lapwing/kernels/kernels.h"
#include "lapwing/mesh/mesh.h"
#include "lapwing/recipe/step.h"
#include "lapwing/region/edit_region.h"
#include "lapwing/run/attachment_file.h"
#include "lapwing/run/mesh_cache.h"
#include "lapwing/run/run_report.h"
#include "lapwing/wrap/wrap.h"

namespace lapwing {

/// Reads a table of landmarks with numeric columns, and converts each row with `target_row`. Throws
/// the errors of `read_number_table`, `number_columns` and `target_row`.
std::vector<TargetRow> read_target_rows(const std::filesystem::path& path);

/// Returns the request of a step. `landmarks` contains the rows of its landmarks. Throws the errors
/// of `targets_of`.
WrapRequest wrap_request(const WrapStep& step, const LandmarkSpec& landmarks, const Mesh& wrapped,
                         const Mesh& scan);

/// State of a run after some of its steps.
struct RunState {
  Mesh mesh;  ///< with the edited positions
  /// Positions as read, one for each vertex of `mesh`. A vertex that a step created has its first
  /// position.
  Positions original;
  /// Region of the last step; empty before the first.
  EditRegion region;
  /// Attachment files of earlier deform steps, with their current positions.
  std::vector<AttachmentFile> carried;
  std::shared_ptr<const SourceFile> read_from;  ///< source of the mesh before any step
  std::vector<std::filesystem::path> inputs;    ///< all files read, except the recipe
  RunReport report;
  std::string morph_target;  ///< name of the morph target to save; empty: save the mesh

  void warn(std::span<const std::string> texts) {
    report.warnings.insert(report.warnings.end(), texts.begin(), texts.end());
  }
  void note(std::span<const std::string> texts) {
    report.notes.insert(report.notes.end(), texts.begin(), texts.end());
  }
};

/// The state of a run, and data that the next step may reuse.
struct RunResult : RunState {
  /// Workspace of the last step if it was a deform step; otherwise empty.
  DeformWorkspace deformed;
};

/// Input and output of a step. A step changes the mesh, the original positions, the region, the
/// carried files, the warnings and the notes of `result`.
struct StepContext {
  std::size_t number;  ///< number of the step in its recipe, from 1; 0 without a recipe
  const std::filesystem::path& base_directory;  ///< base of relative paths in the step
  Kernels& kernels;
  const Progress& progress;
  RunResult& result;
  const MeshCache& meshes;  ///< source of the meshes that the step names
};

/// Runs `step` on the mesh of `on.result`. For the same mesh, the result is bitwise identical to
/// the result of `run_recipe`. A step that changes the triangles also changes the number of entries
/// of `original`. After a transplant, the host's vertices come first, in the same order. Adds to
/// the warnings of the report. Throws the errors of `run_recipe`. After an exception, `on.result`
/// must not be used.
StepReport run_step(const Step& step, const StepContext& on);

/// Returns the report of a deform, without `op`. Moves the timings and the DeformReport out of
/// `done`.
StepReport report_of(Deformed& done);

/// Returns the mesh of each source, from `meshes` and relative to `base_directory`. It is null for
/// a source without a file. Throws as `read_mesh` does.
std::vector<SharedSource> read_source_meshes(std::span<const FileSource> sources,
                                             const std::filesystem::path& base_directory,
                                             const MeshCache& meshes);

/// Returns the mesh that contains the part of `step`, from `meshes` and relative to
/// `base_directory`. It is null if the part comes from the edited mesh. Throws as `read_mesh` does.
std::shared_ptr<const Mesh> read_part_mesh(const TransplantStep& step,
                                           const std::filesystem::path& base_directory,
                                           const MeshCache& meshes);

}  // namespace lapwing
