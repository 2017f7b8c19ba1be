#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "lapwing/base/progress.h"
#include "lapwing/kernels/kernels.h"
#include "lapwing/mesh/mesh.h"
#include "lapwing/region/edit_region.h"
#include "lapwing/step/carried_file.h"
#include "lapwing/step/mesh_shelf.h"
#include "lapwing/step/run_report.h"

namespace lapwing {

/// What the steps that ran so far come to.
struct RunState {
  Mesh mesh;  ///< with the edited positions
  /// The positions that were read, per vertex of `mesh`; a vertex that a step made is where it was
  /// made.
  Positions original;
  /// What the last step concerned; nothing without steps.
  EditRegion region;
  /// The files that deform steps carried along, as those steps left them.
  std::vector<CarriedFile> carried;
  std::shared_ptr<const SourceFile> read_from;  ///< what the mesh was before any step
  std::vector<std::filesystem::path> inputs;  ///< the files that were read, but for the recipe
  RunReport report;
  std::string morph_target;  ///< as which the result is saved; empty: as the mesh itself

  void warn(std::span<const std::string> texts) {
    report.warnings.insert(report.warnings.end(), texts.begin(), texts.end());
  }
  void note(std::span<const std::string> texts) {
    report.notes.insert(report.notes.end(), texts.begin(), texts.end());
  }
};

/// That, and what the next step may use.
struct RunResult : RunState {
  /// What the last step leaves if that is a deform; empty after any other.
  DeformWorkspace deformed;
};

/// One step on its way: what it is carried out with and on. Each step changes the mesh, the
/// original, the region, what is carried, the warnings and the notes of `result`.
struct StepRun {
  std::size_t number;  ///< of the step in its recipe, from 1; 0 without one
  const std::filesystem::path& base_directory;  ///< where the files that it names are looked for
  Kernels& kernels;
  const Progress& progress;
  RunResult& result;
  const MeshShelf& meshes;  ///< where those that it names come from
};

}  // namespace lapwing
