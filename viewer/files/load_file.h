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

/// The mesh that an edit began with.
struct OpenedMesh {
  std::string name;                  ///< of the file or the shape
  std::shared_ptr<const Mesh> mesh;  ///< before any step
  std::optional<MeshStamp> file;     ///< none for a generated mesh
  UpAxis up_axis = UpAxis::y;
  std::shared_ptr<const FilePaint> colors = nullptr;  ///< of the file, with notes; null for a shape
};

/// An edit to show, with the check of its mesh.
struct LoadedFile {
  OpenedMesh opened;
  CheckReport report;  ///< of the mesh as it was opened
  History history;
  bool closed_outward = false;                   ///< from is_closed_outward
  std::optional<InterruptedEdit> restored = {};  ///< the edit that the history continues
  /// For a replay, the number of steps in the history that it continues.
  std::optional<std::size_t> replayed_from = {};
};

/// Reads a mesh or, if `path` ends in .json, runs a recipe on `kernels`, every step one of the
/// history. The files in `carry` follow the surface from then on. Throws what `read_mesh`,
/// `read_recipe`, `run_recipe` and `open_carried` throw.
LoadedFile load_file(const std::filesystem::path& path,
                     const std::vector<std::filesystem::path>& carry, Kernels& kernels,
                     const Progress& progress);

LoadedFile load_shape(const NamedShape& shape);

/// Runs the steps of a recipe on the surface that `history` leads to, whichever mesh it was written
/// for. Throws like `load_file`.
LoadedFile load_replay(const std::filesystem::path& recipe, History history, Kernels& kernels,
                       const Progress& progress);

/// Runs an interrupted edit again. Throws like `load_file`, and InputError if the mesh has changed.
LoadedFile load_interrupted(const InterruptedEdit& edit, Kernels& kernels,
                            const Progress& progress);

}  // namespace lapwing::viewer
