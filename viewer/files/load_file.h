#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "lapwing/base/cancellation.h"
#include "lapwing/doctor/check.h"
#include "lapwing/kernels/kernels.h"
#include "lapwing/mesh/shapes.h"
#include "lapwing/render/camera.h"
#include "lapwing/render/mip_levels.h"
#include "state/history.h"
#include "state/journal.h"

namespace lapwing::viewer {

/// The mesh from which an edit starts.
struct OpenedMesh {
  std::string name;                  ///< name of the file or of the generated shape
  std::shared_ptr<const Mesh> mesh;  ///< the mesh before any step
  std::optional<MeshStamp> file;     ///< not set for a generated mesh
  UpAxis up_axis = UpAxis::y;
  std::shared_ptr<const FilePaint> colors = nullptr;  ///< colours in the file, with notes, or null
};

/// An edit to show, with the check of its mesh.
struct LoadedFile {
  OpenedMesh opened;
  CheckReport report;  ///< report about `opened.mesh`
  History history;
  bool closed_outward = false;                   ///< result of `is_closed_outward`
  std::optional<InterruptedEdit> restored = {};  ///< the edit that the history continues
  /// For a replay, the number of steps in the history that it continues.
  std::optional<std::size_t> replayed_from = {};
};

/// Reads a mesh or, if `path` ends in .json, runs a recipe on `kernels`. Each step of the recipe
/// becomes one or more steps of the history. The files in `carry` follow the surface in later
/// steps. Throws the errors of `read_mesh`, `read_recipe`, `run_recipe` and `open_carried`.
LoadedFile load_file(const std::filesystem::path& path,
                     const std::vector<std::filesystem::path>& carry, Kernels& kernels,
                     const Progress& progress);

LoadedFile load_shape(const NamedShape& shape);

/// Runs the steps of a recipe on the current surface of `history`, even if the recipe names another
/// mesh. Throws the errors of `load_file`.
LoadedFile load_replay(const std::filesystem::path& recipe, History history, Kernels& kernels,
                       const Progress& progress);

/// Restores an interrupted edit. Throws the errors of `load_file`. Throws InputError if the mesh
/// file has changed.
LoadedFile load_interrupted(const InterruptedEdit& edit, Kernels& kernels,
                            const Progress& progress);

}  // namespace lapwing::viewer
