#include "lapwing/transplant/part_library.h"

#include <algorithm>
#include <system_error>
#include <utility>

#include "lapwing/base/errors.h"
#include "lapwing/io/atomic_file.h"
#include "lapwing/io/file_bytes.h"
#include "lapwing/json/json_node.h"
#include "lapwing/transplant/loop_curve.h"

namespace lapwing {
namespace {

namespace fs = std::filesystem;

// Distinguishes preview images from textures.
constexpr std::string_view kMaker = "Lapwing, picture of a part";

fs::path details_path(const fs::path& path) {
  return fs::path(path).replace_extension(".json");
}

std::string count_loops(const std::vector<BoundaryLoop>& loops) {
  return std::to_string(loops.size()) + (loops.size() == 1 ? " boundary loop" : " boundary loops");
}

void require_loop(std::size_t loop, const std::vector<BoundaryLoop>& loops,
                  const std::string& where) {
  if (loop < loops.size()) return;
  throw InputError(where + " names loop " + std::to_string(loop) + ", but the mesh has " +
                   count_loops(loops) + ", counted from 0");
}

// Returns the loop index from the file NAME.json, or nothing if there is no such file.
std::optional<std::size_t> loop_in_details(const fs::path& path) {
  std::error_code missing;
  if (!fs::exists(path, missing)) return std::nullopt;
  const JsonNode root = JsonNode::parse(FileBytes::read(path).view(), path.string());
  root.require_keys({"loop"});
  const auto loop = root.find("loop");
  return loop ? std::optional<std::size_t>(loop->vertex()) : std::nullopt;
}

std::size_t longest(const std::vector<BoundaryLoop>& loops,
                    std::span<const Eigen::Vector3d> positions) {
  const auto length = [&](const BoundaryLoop& loop) { return loop_length(loop, positions); };
  return static_cast<std::size_t>(std::ranges::max_element(loops, {}, length) - loops.begin());
}

// `path` is the mesh file or only the name of the part.
Part part_of(Mesh mesh, const fs::path& path, std::optional<std::size_t> loop,
             const std::string& loop_where) {
  Part part;
  part.name = path.stem().string();
  part.mesh_path = path;
  part.mesh = std::move(mesh);
  part.loops = boundary_loops(part.mesh.topology().triangles, path.string());
  if (part.loops.empty()) {
    throw InputError(path.string() +
                     " has no boundary loop to join a part at; cut a part out of the mesh with "
                     "`lapwing cut`");
  }
  if (loop) require_loop(*loop, part.loops, loop_where);
  part.loop = loop ? *loop : longest(part.loops, part.mesh.positions);
  return part;
}

bool is_mesh_file(const fs::path& path) {
  try {
    format_of(path);
    return true;
  } catch (const InputError&) {
    return false;
  }
}

void require_name(const std::string& name) {
  const bool is_file_name =
      !name.empty() && name.front() != '.' && name.find_first_of("/\\") == std::string::npos;
  if (!is_file_name) {
    throw InputError("the part name \"" + name +
                     "\" cannot be a file name; choose a name that has no slash and does not "
                     "begin with a dot");
  }
}

// Writes the part to `folder` as `name`.
AddedPart write_part(const fs::path& folder, Part part, const std::string& name,
                     const std::string& extension) {
  AddedPart added{std::move(part), {}};
  std::error_code error;
  fs::create_directories(folder, error);
  if (error) throw IoError("cannot create the folder " + folder.string() + ": " + error.message());
  added.part.name = name;
  // Do not use replace_extension, which would remove a suffix of the name after a dot.
  added.part.mesh_path = folder / (name + extension);
  std::vector<fs::path> files = part_files(folder);
  std::erase_if(files, [&](const fs::path& file) { return file.stem() != name; });
  if (fs::exists(details_path(added.part.mesh_path), error)) {
    files.push_back(details_path(added.part.mesh_path));
  }
  if (!picture_may_be_written(added.part.mesh_path)) {
    files.push_back(picture_path(added.part.mesh_path));
  }
  if (!files.empty()) {
    throw InputError(files[0].string() +
                     " already exists; choose another name for the new part (--name)");
  }
  replace_file(details_path(added.part.mesh_path),
               "{\"loop\": " + std::to_string(added.part.loop) + "}\n");
  added.report = write_mesh(added.part.mesh, added.part.mesh_path);
  return added;
}

}  // namespace

fs::path picture_path(const fs::path& path) {
  return fs::path(path).replace_extension(".png");
}

bool picture_is_current(const fs::path& path) {
  std::error_code error;
  const auto drawn = fs::last_write_time(picture_path(path), error);
  if (error || drawn < fs::last_write_time(path, error) || error) return false;
  const auto detailed = fs::last_write_time(details_path(path), error);
  return error || drawn >= detailed;
}

bool picture_may_be_written(const fs::path& path) {
  const fs::path picture = picture_path(path);
  std::error_code error;
  const fs::file_status status = fs::symlink_status(picture, error);
  if (status.type() == fs::file_type::not_found) return true;
  if (status.type() != fs::file_type::regular) return false;
  return is_png_made_by(FileBytes::read(picture).view(), kMaker);
}

void write_part_picture(const fs::path& path, const Image& picture) {
  replace_file(picture_path(path), encode_png(picture, kMaker));
}

Part read_part(const fs::path& path) {
  const fs::path details = details_path(path);
  Mesh mesh = read_mesh(path);
  return part_of(std::move(mesh), path, loop_in_details(details), details.string() + ": /loop");
}

std::vector<fs::path> part_files(const fs::path& folder) {
  std::error_code error;
  std::vector<fs::path> files;
  for (fs::directory_iterator entry(folder, error), end; !error && entry != end;
       entry.increment(error)) {
    std::error_code ignored;
    if (is_mesh_file(entry->path()) && entry->is_regular_file(ignored)) {
      files.push_back(entry->path());
    }
  }
  if (error) throw IoError("cannot read the folder " + folder.string() + ": " + error.message());
  std::ranges::sort(files, {}, [](const fs::path& file) { return std::pair(file.stem(), file); });
  return files;
}

Part find_part(const fs::path& folder, const std::string& name) {
  std::string names;
  for (const fs::path& file : part_files(folder)) {
    if (file.stem() == name) return read_part(file);
    names += (names.empty() ? "" : ", ") + file.stem().string();
  }
  throw InputError("there is no part \"" + name + "\" in " + folder.string() + "; " +
                   (names.empty() ? "the folder has no mesh files" : "the folder has " + names));
}

AddedPart add_part(const fs::path& folder, const fs::path& source, const std::string& name,
                   std::optional<std::size_t> loop) {
  const std::string own_name = name.empty() ? source.stem().string() : name;
  require_name(own_name);
  Part part = part_of(read_mesh(source), source, loop, source.string() + ": the part");
  return write_part(folder, std::move(part), own_name, source.extension().string());
}

AddedPart add_part(const fs::path& folder, Mesh mesh, const std::string& name) {
  require_name(name);
  return write_part(folder, part_of(std::move(mesh), name, {}, name), name, ".obj");
}

}  // namespace lapwing
