#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "lapwing/io/image.h"
#include "lapwing/mesh/mesh.h"

namespace lapwing {

/// How a mesh's file colours faces of one kind: a material of an OBJ file, or a texture of a PLY
/// file.
struct FileMaterial {
  std::string name;                      ///< as in MeshAttributes::materials; of a texture its file
  std::optional<Eigen::Vector3f> color;  ///< sRGB in [0, 1]
  Index image = kNoIndex;                ///< into FileColors::images
  /// The image is looked up at scale * uv + offset; v points upwards, and images repeat.
  Eigen::Vector2d uv_scale = Eigen::Vector2d::Ones();
  Eigen::Vector2d uv_offset = Eigen::Vector2d::Zero();
};

/// What gives a mesh its colours beside its attributes: the materials and images of other files
/// that its file names. Belongs to every mesh with attributes from that file, so also to what is
/// made of it by an edit.
struct FileColors {
  std::vector<FileMaterial> materials;  ///< those that faces have
  std::vector<Image> images;            ///< those that materials have, and no pixels elsewhere
  /// Whether the materials are the textures of a PLY file, which its face property "texnumber"
  /// counts from 0, and not found by name.
  bool are_numbered = false;
  /// What could not be read, and what to do: "path:line: what; next step".
  std::vector<std::string> notes;
};

/// Reads the material libraries and images that `mesh` names, whose file is, or was, at `path`:
/// MTL files (newmtl, Kd, map_Kd), and the images of MeshLab's comments "TextureFile" in PLY files.
/// Nothing throws: what cannot be read becomes a note. Which file a name means, and that none
/// elsewhere is read: find_named_file. Where a library is missing, one called as the mesh is read.
///
/// Memory is bounded: of at most 1024 images, those with the most pixels are halved until all, with
/// their mip levels, fit into 128 MiB, the least that a storage buffer of any device holds; a note
/// says so. While one is read it takes what `read_image` does.
FileColors read_file_colors(const Mesh& mesh, const std::filesystem::path& path);

/// For each face of `mesh` its entry of FileColors::materials, or kNoIndex. Empty if none has one.
std::vector<Index> materials_of_faces(const FileColors& colors, const Mesh& mesh);

}  // namespace lapwing
