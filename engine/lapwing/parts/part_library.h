#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "lapwing/io/image.h"
#include "lapwing/io/mesh_file.h"
#include "lapwing/region/boundary_loops.h"

namespace lapwing {

/// A part in a folder: NAME.obj, .off, .ply or .stl with at least one boundary loop, and beside it
/// NAME.json, which may be missing: {"loop": 1}, the number of the loop it is joined at. Without it
/// that is the longest one.
struct Part {
  std::string name;
  std::filesystem::path mesh_path;
  Mesh mesh;
  std::vector<BoundaryLoop> loops;  ///< as `boundary_loops` has them
  std::size_t loop = 0;             ///< the one it is joined at
};

/// Reads the part in `path`. Throws what `read_mesh` throws, and InputError for a mesh without a
/// boundary loop, a boundary that is no set of loops, and details that cannot be read.
Part read_part(const std::filesystem::path& path);

/// The part called `name` in `folder`. Throws InputError, naming the ones there are, when there is
/// none of that name, and what `read_part` throws.
Part find_part(const std::filesystem::path& folder, const std::string& name);

/// The mesh files in `folder` by name, without reading them. Of files that differ in their
/// extension alone all are named. Throws IoError when the folder cannot be read.
std::vector<std::filesystem::path> part_files(const std::filesystem::path& folder);

/// Where the picture of the part in `path` belongs.
std::filesystem::path picture_path(const std::filesystem::path& path);

/// Whether that picture is there, and not older than the mesh and its details.
bool picture_is_current(const std::filesystem::path& path);

/// Whether the picture may be written: nothing is in its place but, at most, a picture that
/// `write_part_picture` made. A texture of that name stays, and so does what a link leads to.
bool picture_may_be_written(const std::filesystem::path& path);

/// Writes `picture` as that of the part in `path`. Throws IoError.
void write_part_picture(const std::filesystem::path& path, const Image& picture);

/// What `add_part` did.
struct AddedPart {
  Part part;
  WriteReport report;  ///< on the mesh file
};

/// Copies the mesh file `source` into `folder`, which is made when it is not there, as a part
/// called `name` (its own name when empty), joined at loop number `loop` (the longest one when not
/// given). Throws what `read_part` throws, and InputError for a closed mesh, naming `lapwing cut`;
/// a loop that the mesh does not have; a name that is no file name; and one that is taken.
AddedPart add_part(const std::filesystem::path& folder, const std::filesystem::path& source,
                   const std::string& name, std::optional<std::size_t> loop);

/// The same of a mesh that is in no file, written as OBJ and joined at its longest loop.
AddedPart add_part(const std::filesystem::path& folder, Mesh mesh, const std::string& name);

}  // namespace lapwing
