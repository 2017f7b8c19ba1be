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

/// The materials of a mesh as its source file defines them, to be written in another format.
struct MaterialTransfer {
  struct ImageFile {
    std::string name;                                ///< of the file, without a folder
    std::optional<std::filesystem::path> path = {};  ///< nothing if embedded in the source file
    std::shared_ptr<const std::string> bytes = {};
  };
  struct Entry {
    Material material;
    Index image = kNoIndex;  ///< into `images`
  };
  std::vector<Entry> entries;  ///< one for each of MeshAttributes::materials
  std::vector<ImageFile> images;
};

/// Reads the materials of `mesh`, whose source file is or was at `path`. Without a `path` they have
/// only names. What cannot be read goes to `report`.
MaterialTransfer read_materials(const Mesh& mesh, const std::filesystem::path& path,
                                WriteReport& report);

/// Returns the MTL file for the OBJ file `target`, and the images that are not yet in its folder.
/// An existing image of other content is not replaced; the new one gets another name.
std::vector<FileContent> mtl_files(const MaterialTransfer& materials,
                                   const std::filesystem::path& target);

/// The lists of a glTF document that materials need, each as JSON with its key, such as
/// `"materials":[...]`, separated by commas.
struct GltfMaterials {
  std::string json;
  std::vector<FileContent> files;  ///< images beside a .gltf
};
/// Writes images into the buffer of a GLB, or beside a .gltf. Images that are neither PNG nor JPEG
/// become PNG. Reports images that cannot be read, and what glTF cannot hold.
GltfMaterials gltf_materials(const MaterialTransfer& materials, const std::filesystem::path& target,
                             GltfAppender& appender, WriteReport& report);

}  // namespace lapwing
