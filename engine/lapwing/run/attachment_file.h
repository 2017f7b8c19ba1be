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

/// A file whose points follow the edited surface: a mesh, a point cloud (a mesh file without faces)
/// or a table of points. The quaternions of the points (columns or PLY properties qw, qx, qy, qz)
/// and the normals of a cloud or table rotate with the surface. The normals of a mesh are
/// recomputed from its faces.
class AttachmentFile {
 public:
  /// Reads `file`. Throws as `read_mesh` and `read_point_table` do. Throws InputError, naming the
  /// vertex, if a mesh has no vertices or a position that is not finite.
  explicit AttachmentFile(std::filesystem::path file);

  const std::filesystem::path& file() const { return file_; }
  /// The path to save to, or empty if no step names one.
  std::filesystem::path save;

  const Positions& positions() const;
  /// Returns the mesh or point cloud, or null for a table.
  const Mesh* mesh() const { return std::get_if<Mesh>(&content_); }
  /// Replaces the positions, and rotates the normals and quaternions.
  void move(CarriedPoints carried);

  /// Returns `save` or, if it is empty, the carried_path next to `result`.
  std::filesystem::path target(const std::filesystem::path& result) const;

  /// Throws InputError if the content cannot be written with this extension. A table keeps the
  /// format that it was read from.
  void require_format(const std::filesystem::path& target) const;

  /// Writes the content, as `write_mesh` does. In a table, only the bytes of changed numbers
  /// change.
  WriteReport write(const std::filesystem::path& target, FileReplacements& files) const;

 private:
  std::filesystem::path file_;
  std::variant<Mesh, PointTable> content_;
  bool turns_properties_ = false;  ///< quaternions of a mesh changed, so its file is newly written
};

/// Throws InputError unless all `files` can be written together with `result`. A target must not be
/// the result, an input or the target of another file.
void require_targets(std::span<const AttachmentFile> files, const std::filesystem::path& result,
                     std::span<const std::filesystem::path> inputs);

/// Writes each file to its target and adds it to `written`. `result` determines the default
/// targets. Each line of the report begins with the name of the target. Throws as
/// `AttachmentFile::write` does.
WriteReport write_carried(std::span<const AttachmentFile> files,
                          const std::filesystem::path& result, FileReplacements& written);

}  // namespace lapwing
