#include "lapwing/run/attachment_file.h"

#include <algorithm>
#include <array>
#include <string_view>

#include "lapwing/base/errors.h"
#include "lapwing/io/paths.h"
#include "lapwing/recipe/recipe_files.h"

namespace lapwing {
namespace {

namespace fs = std::filesystem;
using Eigen::Quaterniond;
using Eigen::Vector3d;

constexpr std::array<std::string_view, 4> kQuaternion{"qw", "qx", "qy", "qz"};

Mesh read_carried_mesh(const fs::path& file) {
  Mesh mesh = read_mesh(file);
  if (mesh.positions.empty()) throw InputError(file.string() + ": it has no vertices to carry");
  for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
    if (mesh.positions[v].allFinite()) continue;
    throw InputError(file.string() + ": the position of vertex " + std::to_string(v) +
                         " is not finite; repair the mesh with `lapwing check --fix`",
                     {static_cast<Index>(v)});
  }
  return mesh;
}

std::variant<Mesh, PointTable> read_content(const fs::path& file) {
  if (!table_extension(file).empty()) return read_point_table(file);
  return read_carried_mesh(file);
}

// Returns the four properties in the order of kQuaternion, or nothing unless all exist.
std::vector<double*> quaternion_properties(std::vector<ExtraAttribute>& extras) {
  std::vector<double*> found;
  for (const std::string_view name : kQuaternion) {
    const auto at = std::find_if(extras.begin(), extras.end(), [&](const ExtraAttribute& extra) {
      return extra.name == name && extra.components == 1;
    });
    if (at == extras.end()) return {};
    found.push_back(at->values.data());
  }
  return found;
}

// Identity rotations are skipped, so that points that did not rotate are bitwise unchanged.
bool turns(const Quaterniond& rotation) {
  return !rotation.vec().isZero(0.0);
}

void turn_normals(std::span<const Quaterniond> rotations, std::vector<Vector3d>& normals) {
  for (std::size_t p = 0; p < normals.size(); ++p) {
    if (turns(rotations[p])) normals[p] = rotations[p] * normals[p];
  }
}

// Returns whether a quaternion changed.
bool turn_attributes(std::span<const Quaterniond> rotations, Mesh& mesh) {
  const bool is_cloud = mesh.face_count() == 0;
  if (is_cloud && mesh.attributes().normals.size() == rotations.size()) {
    turn_normals(rotations, mesh.edit_attributes().normals);
  }
  const std::vector<double*> parts = quaternion_properties(mesh.edit_attributes().vertex_extras);
  if (parts.empty()) return false;
  bool any = false;
  for (std::size_t p = 0; p < rotations.size(); ++p) {
    if (!turns(rotations[p])) continue;
    const Quaterniond q =
        rotations[p] * Quaterniond(parts[0][p], parts[1][p], parts[2][p], parts[3][p]);
    const std::array turned{q.w(), q.x(), q.y(), q.z()};
    for (std::size_t k = 0; k < turned.size(); ++k) parts[k][p] = turned[k];
    any = true;
  }
  return any;
}

}  // namespace

AttachmentFile::AttachmentFile(fs::path file)
    : file_(std::move(file)), content_(read_content(file_)) {}

const Positions& AttachmentFile::positions() const {
  return std::visit([](const auto& content) -> const Positions& { return content.positions; },
                    content_);
}

void AttachmentFile::move(CarriedPoints carried) {
  if (auto* points = std::get_if<PointTable>(&content_)) {
    turn_normals(carried.rotations, points->normals);
    for (std::size_t p = 0; p < points->rotations.size(); ++p) {
      if (!turns(carried.rotations[p])) continue;
      points->rotations[p] = carried.rotations[p] * points->rotations[p];
    }
    points->positions = std::move(carried.positions);
  } else {
    Mesh& mesh = std::get<Mesh>(content_);
    turns_properties_ = turn_attributes(carried.rotations, mesh) || turns_properties_;
    mesh.positions = std::move(carried.positions);
  }
}

fs::path AttachmentFile::target(const fs::path& result) const {
  return save.empty() ? carried_path(file_, result) : save;
}

WriteReport AttachmentFile::write(const fs::path& target, FileReplacements& files) const {
  if (const auto* mesh = std::get_if<Mesh>(&content_)) {
    return write_mesh(*mesh, target, files, {.anew = turns_properties_});
  }
  files.add(target, bytes_of(std::get<PointTable>(content_)));
  return {};
}

void AttachmentFile::require_format(const fs::path& target) const {
  if (std::holds_alternative<Mesh>(content_)) {
    format_of(target);
  } else if (table_extension(target) != table_extension(file_)) {
    throw InputError(target.string() + ": a table keeps its format; end its name in " +
                     std::string(table_extension(file_)));
  }
}

void require_targets(std::span<const AttachmentFile> files, const fs::path& result,
                     std::span<const fs::path> inputs) {
  std::vector<fs::path> taken{result};
  for (const AttachmentFile& file : files) {
    const fs::path target = file.target(result);
    const auto refuse = [&](const std::string& why) {
      throw InputError(file.file().string() + ": it would be saved as " + target.string() + ", " +
                       why + "; give it another name with \"save\"");
    };
    file.require_format(target);
    const auto is_target = [&](const fs::path& path) { return is_same_file(path, target); };
    if (std::any_of(inputs.begin(), inputs.end(), is_target)) {
      refuse("which is an input of the edit");
    }
    if (std::any_of(taken.begin(), taken.end(), is_target)) {
      refuse("which is another result of the edit");
    }
    taken.push_back(target);
  }
}

WriteReport write_carried(std::span<const AttachmentFile> files, const fs::path& result,
                          FileReplacements& written) {
  WriteReport all;
  for (const AttachmentFile& file : files) {
    const fs::path target = file.target(result);
    const std::string name = target.filename().string() + ": ";
    const WriteReport report = file.write(target, written);
    for (const std::string& line : report.not_carried) all.not_carried.push_back(name + line);
    for (const std::string& note : report.notes) all.notes.push_back(name + note);
  }
  return all;
}

}  // namespace lapwing
