#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "lapwing/base/progress.h"
#include "lapwing/doctor/check.h"
#include "lapwing/kernels/kernels.h"
#include "lapwing/mesh/shapes.h"
#include "lapwing/mesh/topology.h"
#include "lapwing/render/camera.h"
#include "lapwing/render/surface_paint.h"

namespace lapwing::viewer {

/// A mesh with all that showing it takes, but for the device.
struct LoadedFile {
  std::string name;  ///< of the file or the shape
  Mesh mesh;
  Topology topology;
  CheckReport report;
  bool closed_outward = false;  ///< as is_closed_outward says
  UpAxis up_axis = UpAxis::y;
  Positions rest;                    ///< before a recipe's steps; empty without
  std::vector<VertexClass> classes;  ///< of a recipe's last step; empty without
  std::vector<std::string> notes;    ///< of the recipe, for the log
};

/// Reads a mesh or, if `path` ends in .json, carries out a recipe on `kernels`. Throws what
/// `read_mesh`, `read_recipe` and `run_recipe` throw.
LoadedFile load_file(const std::filesystem::path& path, Kernels& kernels, const Progress& progress);

LoadedFile load_shape(const NamedShape& shape);

}  // namespace lapwing::viewer
