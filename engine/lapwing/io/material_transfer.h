#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "lapwing/io/gltf_edits.h"
#include "lapwing/io/gltf_patch.h"
#include "lapwing/io/materials.h"
#include "lapwing/io/mesh_file.h"
#include "lapwing/mesh/mesh.h"

namespace lapwing {

/// Materials of a mesh, read from its source file so that another format can store them.
struct MaterialTransfer {
  struct ImageFile {
    std::string name;                                ///< name of the file, without a folder
    std::optional<std::filesystem::path> path = {};  ///< empty if embedded in the source file
    std::shared_ptr<const std::string> bytes = {};
  };
  struct Entry {
    Material material;
    Index image = kNoIndex;  ///< index into `images`
  };
  std::vector<Entry> entries;  ///< one for each of MeshAttributes::materials, or each texture
  std::vector<ImageFile> images;
};

/// Reads the materials of `mesh`, or its textures if it has no materials. `path` is the path of its
/// source file, which may no longer exist. If `path` is empty, the materials have only names.
/// `report` lists all data that could not be read.
MaterialTransfer read_materials(const Mesh& mesh, const std::filesystem::path& path,
                                WriteReport& report);

/// Returns `mesh` with materials instead of the textures that its comments name (texture_names), if
/// it has no other materials. Each has the name of its image.
Mesh with_texture_materials(const Mesh& mesh);

/// Replaces the materials of `mesh` by textures that a PLY file can name. Returns the images that
/// are not yet in the folder of `target`. Reports what is lost.
std::vector<FileContent> add_ply_textures(const MaterialTransfer& materials,
                                          const std::filesystem::path& target, Mesh& mesh,
                                          WriteReport& report);

/// Returns the MTL file for the OBJ file `target`, and the images that are not yet in its folder.
/// If the folder contains another image of the same name, the new image gets a different name.
std::vector<FileContent> mtl_files(const MaterialTransfer& materials,
                                   const std::filesystem::path& target);

/// Contains the data that the materials add to a glTF document. `json` contains the members of the
/// root object, such as `"materials":[...]`, separated by commas.
struct GltfMaterials {
  std::string json;
  std::vector<FileContent> files;  ///< images to store beside a .gltf file
};
/// Adds images to the buffer of a GLB file, or to `files` for a .gltf file. Converts images that
/// are neither PNG nor JPEG to PNG. Reports images that cannot be read, and properties that glTF
/// cannot store.
GltfMaterials gltf_materials(const MaterialTransfer& materials, const std::filesystem::path& target,
                             GltfAppender& appender, WriteReport& report);

}  // namespace lapwing
