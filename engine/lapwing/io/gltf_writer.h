#pragma once

#include <filesystem>
#include <vector>

#include "lapwing/io/gltf_patch.h"
#include "lapwing/io/mesh_file.h"

namespace lapwing {

/// A glTF file of `mesh` alone, made anew: GLB, or JSON and, beside it, a ".bin" of the same name;
/// the extension of `target` says which. Materials by name. Throws InputError for positions that
/// 32-bit floats do not hold.
std::vector<FileContent> write_gltf(const Mesh& mesh, const std::filesystem::path& target,
                                    WriteReport& report);

}  // namespace lapwing
