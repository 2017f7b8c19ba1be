#pragma once

#include <filesystem>
#include <vector>

#include "lapwing/io/gltf_patch.h"
#include "lapwing/io/mesh_file.h"

namespace lapwing {

/// Returns a new glTF file of `mesh` alone. The extension of `target` selects GLB, or JSON with a
/// ".bin" of the same name beside it. Materials have only names. Throws InputError if 32-bit floats
/// cannot hold a position.
std::vector<FileContent> write_gltf(const Mesh& mesh, const std::filesystem::path& target,
                                    WriteReport& report);

}  // namespace lapwing
