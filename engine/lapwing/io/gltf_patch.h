#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "lapwing/io/mesh_file.h"
#include "lapwing/io/source_file.h"

namespace lapwing {

/// A file in memory.
struct FileContent {
  std::filesystem::path path;
  std::string bytes;
};

/// The glTF file at `target`, and those that its buffers are in, with the positions of `mesh`,
/// which `source` describes mostly: the files that it was read from, byte for byte, but for the
/// positions that moved, the normals and tangents there, and the bounds ("min", "max") of those
/// accessors. Buffers in files of their own get the target's name, unless the target is the file
/// that was read. The first is the target itself.
///
/// What several meshes share, and positions in whole numbers or nowhere at all, get accessors of
/// their own at the end (see GltfNumbers). `report` notes images that are not beside the target.
/// Throws what GltfNumbers does.
///
/// With a name, `morph_target`, nothing is moved: see add_morph_target. A mesh that `source` does
/// not describe has other triangles: see splice_triangles.
std::vector<FileContent> patch_gltf(const SourceFile& source, const Mesh& mesh,
                                    const std::filesystem::path& target,
                                    const std::string& morph_target, WriteReport& report);

}  // namespace lapwing
