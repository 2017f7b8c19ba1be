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
/// NAME.json beside it, {"loop": 1}, gives the number of the loop to join; default: the longest.
struct Part {
  std::string name;
  std::filesystem::path mesh_path;
  Mesh mesh;
  std::vector<BoundaryLoop> loops;  ///< in the order of `boundary_loops`
  std::size_t loop = 0;             ///< number of the loop to join
};

/// Reads the part in `path`. Throws what `read_mesh` throws, and InputError if the mesh has no
/// boundary loop, its boundary is not a set of loops, or the details cannot be read.
Part read_part(const std::filesystem::path& path);

/// Reads the part called `name` in `folder`. Throws InputError, naming the existing parts, if there
/// is none of that name, and what `read_part` throws.
Part find_part(const std::filesystem::path& folder, const std::string& name);

/// Returns the mesh files in `folder`, sorted by name, without reading them. Lists all files that
/// differ only in their extension. Throws IoError if the folder cannot be read.
std::vector<std::filesystem::path> part_files(const std::filesystem::path& folder);

/// Returns the path of the picture of the part in `path`.
std::filesystem::path picture_path(const std::filesystem::path& path);

/// Returns whether that picture exists and is not older than the mesh and its details.
bool picture_is_current(const std::filesystem::path& path);

/// Returns whether the picture may be written: no file is in its place, or one that
/// `write_part_picture` wrote. Textures of that name and links must not be overwritten.
bool picture_may_be_written(const std::filesystem::path& path);

/// Writes `picture` as that of the part in `path`. Throws IoError.
void write_part_picture(const std::filesystem::path& path, const Image& picture);

/// The result of `add_part`.
struct AddedPart {
  Part part;
  WriteReport report;  ///< for the mesh file
};

/// Copies the mesh file `source` into `folder`, which is created if missing, as a part called
/// `name` (if empty, the file's own name). `loop` is the number of the loop to join; default: the
/// longest. Throws what `read_part` throws, and InputError if the mesh is closed (naming
/// `lapwing cut`) or has no such loop, or if the name is not a file name or is taken.
AddedPart add_part(const std::filesystem::path& folder, const std::filesystem::path& source,
                   const std::string& name, std::optional<std::size_t> loop);

/// The same for a mesh without a file, written as OBJ and joined at its longest loop.
AddedPart add_part(const std::filesystem::path& folder, Mesh mesh, const std::string& name);

}  // namespace lapwing
