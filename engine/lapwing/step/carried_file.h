#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <variant>
#include <vector>

#include "lapwing/deform/modifiers/attachments.h"
#include "lapwing/io/mesh_file.h"
#include "lapwing/io/point_table.h"
#include "lapwing/mesh/mesh.h"

namespace lapwing {

/// Where a carried file goes that names no place: in the folder of the result the file's name with
/// "-carried" behind its stem, hat.obj as hat-carried.obj.
std::filesystem::path carried_path(const std::filesystem::path& file,
                                   const std::filesystem::path& result);

/// A file that follows the edited surface: a mesh, a point cloud (a mesh file without faces) or a
/// table of points. Along with the positions turn its quaternions (columns or PLY properties qw,
/// qx, qy, qz, one per point) and the normals of a cloud or table; those of a mesh come from its
/// faces, as with every edit.
class CarriedFile {
 public:
  /// Reads `file`. Throws what `read_mesh` and `read_point_table` do, and InputError, naming the
  /// vertex, for a mesh without vertices or with a position that is not finite.
  explicit CarriedFile(std::filesystem::path file);

  const std::filesystem::path& file() const { return file_; }
  /// Where it is to be saved, if a step says so; else empty.
  std::filesystem::path save;

  const Positions& positions() const;
  /// What it is if it is a mesh or a cloud, which is one without faces; null for a table.
  const Mesh* mesh() const { return std::get_if<Mesh>(&content_); }
  /// Puts the points where they were carried.
  void move(CarriedPoints carried);

  /// Where it goes beside a result at `result`: `save`, or its carried_path.
  std::filesystem::path target(const std::filesystem::path& result) const;

  /// Throws InputError for an extension that it cannot be written with: a table goes to the format
  /// that it came from.
  void require_format(const std::filesystem::path& target) const;

  /// Writes it, as `write_mesh` does; a table keeps all bytes but the numbers that changed.
  WriteReport write(const std::filesystem::path& target, FileReplacements& files) const;

 private:
  std::filesystem::path file_;
  std::variant<Mesh, PointTable> content_;
  bool turns_properties_ = false;  ///< of a mesh: quaternions turned, so that its file is made anew
};

/// Throws InputError unless all of `files` can be written beside a result at `result`: each to a
/// path of its own, which is neither the result's nor that of an input.
void require_targets(std::span<const CarriedFile> files, const std::filesystem::path& result,
                     std::span<const std::filesystem::path> inputs);

/// Writes each to its target beside a result at `result`, among the `written`. What there is to say
/// of one begins with its target's name. Throws what `CarriedFile::write` does.
WriteReport write_carried(std::span<const CarriedFile> files, const std::filesystem::path& result,
                          FileReplacements& written);

}  // namespace lapwing
