#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "lapwing/io/materials.h"
#include "lapwing/mesh/mesh.h"

namespace lapwing {

/// The definition of a material, and the file that holds it.
struct FoundMaterial {
  Material material;
  std::filesystem::path file;
};

/// Returns the definition of each of MeshAttributes::materials, from the files that `mesh` names;
/// nothing for materials that no face uses or that are not defined. `path` is where the file of the
/// mesh is or was. Problems become `notes`. If a library is missing, reads the .mtl file named like
/// the mesh.
std::vector<std::optional<FoundMaterial>> find_materials(const Mesh& mesh,
                                                         const std::filesystem::path& path,
                                                         std::vector<std::string>& notes);

/// Returns the image `name` that the file `namer` refers to: beside `namer`, else beside `mesh`.
/// Nothing, and a note, if it is in neither folder.
std::optional<std::filesystem::path> find_image(const std::string& name,
                                                const std::filesystem::path& namer,
                                                const std::filesystem::path& mesh,
                                                std::vector<std::string>& notes);

}  // namespace lapwing
