#pragma once

#include <filesystem>
#include <span>
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

/// Returns the glTF file for `target`, followed by its separate buffer files. They contain the
/// positions of `mesh`, which was read from `source`, the updated normals and tangents near moved
/// vertices, and the updated bounds ("min", "max"). All other bytes are those of the files that
/// were read. Buffer files get the target's name, unless the target is the file that was read.
///
/// Accessors that several meshes share, and positions stored as integers or not at all, are
/// replaced by new ones (see GltfNumbers). `report` notes images that are not beside the target.
/// Throws what GltfNumbers throws, and InputError if the data that changes has a compressed copy.
///
/// If `morph_targets` is not empty, the positions stay and morph targets are added (see
/// add_morph_targets). If `source` does not describe `mesh`, new primitives replace the triangles
/// of the objects that changed. Throws InputError if a changed object has morph targets or has no
/// triangle left.
std::vector<FileContent> patch_gltf(const SourceFile& source, const Mesh& mesh,
                                    const std::filesystem::path& target,
                                    std::span<const MorphTarget> morph_targets,
                                    WriteReport& report);

}  // namespace lapwing
