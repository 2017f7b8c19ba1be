#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "lapwing/io/material_library.h"

namespace lapwing {

/// The materials of the glTF file at `path`, by the names that read_gltf gives them: base colour,
/// and the image of its texture where that is a file beside it. One inside the file becomes one of
/// the `notes`. Throws what reading the file does.
std::vector<Material> read_gltf_materials(const std::filesystem::path& path,
                                          std::vector<std::string>& notes);

}  // namespace lapwing
