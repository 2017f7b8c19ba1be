#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "lapwing/io/material_library.h"

namespace lapwing {

/// Returns the materials of the glTF file at `path`, with the names that read_gltf gives them,
/// their base colour, and their image if it is a separate file. Embedded images become one of the
/// `notes`. Throws what reading the file throws.
std::vector<Material> read_gltf_materials(const std::filesystem::path& path,
                                          std::vector<std::string>& notes);

}  // namespace lapwing
