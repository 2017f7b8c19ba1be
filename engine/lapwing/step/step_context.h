#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "lapwing/base/progress.h"
#include "lapwing/kernels/kernels.h"
#include "lapwing/mesh/mesh.h"
#include "lapwing/region/edit_region.h"
#include "lapwing/step/attachment_file.h"
#include "lapwing/step/mesh_cache.h"
#include "lapwing/step/run_report.h"

namespace lapwing {

/// State of a run after some of its steps.
struct RunState {
  Mesh mesh;  ///< with the edited positions
  /// Positions as read, one for each vertex of `mesh`. A vertex that a step created has its first
  /// position.
  Positions original;
  /// Region of the last step; empty before the first.
  EditRegion region;
  /// Files that deform steps carried along, at their current positions.
  std::vector<AttachmentFile> carried;
  std::shared_ptr<const SourceFile> read_from;  ///< source of the mesh before any step
  std::vector<std::filesystem::path> inputs;    ///< all files read, except the recipe
  RunReport report;
  std::string morph_target;  ///< name to save under; empty: save the mesh

  void warn(std::span<const std::string> texts) {
    report.warnings.insert(report.warnings.end(), texts.begin(), texts.end());
  }
  void note(std::span<const std::string> texts) {
    report.notes.insert(report.notes.end(), texts.begin(), texts.end());
  }
};

/// The state, with data that the next step may reuse.
struct RunResult : RunState {
  /// Workspace of the last step if that was a deform; otherwise empty.
  DeformWorkspace deformed;
};

/// Input and output of a step. A step changes the mesh, the original positions, the region, the
/// carried files, the warnings and the notes of `result`.
struct StepContext {
  std::size_t number;  ///< of the step in its recipe, from 1; 0 without a recipe
  const std::filesystem::path& base_directory;  ///< of the files that the step names
  Kernels& kernels;
  const Progress& progress;
  RunResult& result;
  const MeshCache& meshes;  ///< the meshes that the step names
};

}  // namespace lapwing
