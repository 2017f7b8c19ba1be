#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "lapwing/io/materials.h"
#include "lapwing/mesh/mesh.h"

namespace lapwing {

// MeshLab stores the textures of a PLY file as comments, "TextureFile NAME". The face property
// "texnumber" contains the number of each face's texture, counted from 0.
inline constexpr std::string_view kTextureComment = "TextureFile ";
inline constexpr std::string_view kTextureNumber = "texnumber";

/// Returns the names of the images in the comments of a PLY file.
std::vector<std::string> texture_names(const MeshAttributes& attributes);
/// Returns the number of each face's texture, or kNoIndex if it is not below `count`. Without the
/// face property, all faces have the first texture.
std::vector<Index> textures_of_faces(const Mesh& mesh, std::size_t count);

/// A material and the file that defines it.
struct FoundMaterial {
  Material material;
  std::filesystem::path file;
};

/// Returns the definition of each of MeshAttributes::materials, from the files that `mesh` names.
/// An entry is empty if no face uses the material or no file defines it. `path` is the path of the
/// mesh file, which may no longer exist. Each problem adds one of `notes`. If a library is missing,
/// the function reads the .mtl file with the name of the mesh file instead.
std::vector<std::optional<FoundMaterial>> find_materials(const Mesh& mesh,
                                                         const std::filesystem::path& path,
                                                         std::vector<std::string>& notes);

/// Returns the path of the image `name`. The file `namer` contains this name. Searches the folder
/// of `namer` and then that of `mesh`. If neither contains the image, returns nullopt and adds a
/// note.
std::optional<std::filesystem::path> find_image(const std::string& name,
                                                const std::filesystem::path& namer,
                                                const std::filesystem::path& mesh,
                                                std::vector<std::string>& notes);

}  // namespace lapwing
