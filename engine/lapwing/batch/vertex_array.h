#pragma once

#include <filesystem>
#include <span>

namespace lapwing {

/// Writes the vertices of mesh files as one .npy file: a float64 array of shape
/// (meshes.size(), n, 3), in the order of `meshes`. If a job has no result, its path is empty and
/// its row contains NaN. Throws InputError if there is no mesh or if the meshes have different
/// numbers of vertices. Also throws the errors of `read_mesh` and `replace_file`.
void write_vertex_array(const std::filesystem::path& path,
                        std::span<const std::filesystem::path> meshes);

}  // namespace lapwing
