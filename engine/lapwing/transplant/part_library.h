#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "lapwing/io/image.h"
#include "lapwing/io/mesh_file.h"
#include "lapwing/region/boundary_loops.h"

namespace lapwing {

/// A part in a folder: NAME.obj, .off, .ply or .stl with at least one boundary loop. An optional
/// file NAME.json, {"loop": 1}, contains the index of the loop to join. By default, it is the
/// longest loop.
struct Part {
  std::string name;
  std::filesystem::path mesh_path;
  Mesh mesh;
  std::vector<BoundaryLoop> loops;  ///< in the order of `boundary_loops`
  std::size_t loop = 0;             ///< index of the loop to join
};

/// Reads the part from the mesh file `path`. Throws the errors of `read_mesh`, and InputError if
/// the mesh has no boundary loop, its boundary is not a set of loops, or NAME.json cannot be read.
Part read_part(const std::filesystem::path& path);

/// Reads the part called `name` in `folder`. Throws InputError, which names the existing parts, if
/// there is no such part. Also throws the errors of `read_part`.
Part find_part(const std::filesystem::path& folder, const std::string& name);

/// Returns the mesh files in `folder`, sorted by name, without reading them. Files that differ only
/// in their extension are all listed. Throws IoError if the folder cannot be read.
std::vector<std::filesystem::path> part_files(const std::filesystem::path& folder);

/// Returns the path of the preview image, NAME.png, of the part in `path`.
std::filesystem::path picture_path(const std::filesystem::path& path);

/// Returns whether the preview image exists and is not older than the mesh file and NAME.json.
bool picture_is_current(const std::filesystem::path& path);

/// Returns whether the preview image may be written: there is no file NAME.png, or
/// `write_part_picture` has written it. Textures of this name and links must not be overwritten.
bool picture_may_be_written(const std::filesystem::path& path);

/// Writes `picture` as the preview image of the part in `path`. Throws IoError.
void write_part_picture(const std::filesystem::path& path, const Image& picture);

/// The result of `add_part`.
struct AddedPart {
  Part part;
  WriteReport report;  ///< report about the mesh file
};

/// Copies the mesh file `source` as a part called `name`, by default the name of the file, into
/// `folder`, which is created if necessary. `loop` is the index of the loop to join, by default the
/// longest. Throws the errors of `read_part`, and InputError if the mesh is closed or has no such
/// loop, or if the name is not a file name or already exists.
AddedPart add_part(const std::filesystem::path& folder, const std::filesystem::path& source,
                   const std::string& name, std::optional<std::size_t> loop);

/// Adds a mesh that has no file as a part, written as OBJ and joined at its longest loop.
AddedPart add_part(const std::filesystem::path& folder, Mesh mesh, const std::string& name);

}  // namespace lapwing
