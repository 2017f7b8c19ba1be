#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "lapwing/io/image.h"
#include "lapwing/mesh/mesh.h"

namespace lapwing {

/// A material of an OBJ or glTF file, or a texture of a PLY file.
struct FileMaterial {
  std::string name;                      ///< as in MeshAttributes::materials, or the texture's file
  std::optional<Eigen::Vector3f> color;  ///< sRGB in [0, 1]
  Index image = kNoIndex;                ///< into FileColors::images
  /// The image is looked up at scale * uv + offset; v points upwards, and images repeat.
  Eigen::Vector2d uv_scale = Eigen::Vector2d::Ones();
  Eigen::Vector2d uv_offset = Eigen::Vector2d::Zero();
  bool is_clamped = false;  ///< the image is not repeated; a note counts the faces beyond it
};

/// The colours that a mesh takes from other files: the materials and images that its file names.
/// They apply to every mesh with attributes from that file, also after an edit.
struct FileColors {
  std::vector<FileMaterial> materials;  ///< those that faces use
  std::vector<Image> images;            ///< those that materials use; without pixels if unreadable
  /// Whether the materials are the textures of a PLY file, numbered from 0 by the face property
  /// "texnumber". Otherwise faces find their material by name.
  bool are_numbered = false;
  /// What could not be read, and what to do: "path:line: what; next step".
  std::vector<std::string> notes;
};

/// Reads the materials and images that `mesh` names: MTL files (newmtl, Kd, map_Kd), glTF
/// materials, and the images of MeshLab's "TextureFile" comments in PLY files. `path` is where the
/// file of the mesh is or was. Problems become notes, not exceptions. find_named_file resolves the
/// names, never to another folder. If a library is missing, reads the .mtl file named like the
/// mesh.
///
/// Memory is bounded. At most 1024 images are read, and the largest are halved until all, with mip
/// levels, fit into 128 MiB; a note says so. Every Vulkan device allows storage buffers of that
/// size. Reading one image temporarily takes the memory of `read_image`.
FileColors read_file_colors(const Mesh& mesh, const std::filesystem::path& path);

/// Returns the index into FileColors::materials of each face, or kNoIndex; empty if none has one.
std::vector<Index> materials_of_faces(const FileColors& colors, const Mesh& mesh);

}  // namespace lapwing
