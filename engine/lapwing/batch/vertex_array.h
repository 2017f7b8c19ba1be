#pragma once

#include <filesystem>
#include <span>

namespace lapwing {

/// Writes the vertices of mesh files as one .npy file: an array of float64 and of shape
/// (meshes.size(), n, 3), in the order of `meshes`. A job without a result has an empty path, and
/// NaN in its row. Throws InputError if there is no mesh or if the meshes have different numbers of
/// vertices, and as `read_mesh` and `replace_file` do.
void write_vertex_array(const std::filesystem::path& path,
                        std::span<const std::filesystem::path> meshes);

}  // namespace lapwing
