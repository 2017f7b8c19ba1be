#pragma once

#include <cstdint>
#include <limits>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include <Eigen/Core>

#include "lapwing/io/source_file.h"
#include "lapwing/mesh/mesh.h"

namespace lapwing {

/// Counts things by name, for MeshAttributes::uneditable.
class Tally {
 public:
  void add(std::string_view name, std::size_t count = 1) { counts_[std::string(name)] += count; }
  /// Returns lines such as "line elements (6)", sorted by name.
  std::vector<std::string> lines() const;

 private:
  std::map<std::string, std::size_t> counts_;
};

/// These entries of MeshAttributes::uneditable may be colours.
inline constexpr std::string_view kColorMapIndices = "colour map indices";
inline constexpr std::string_view kUndeclaredNumbers =
    "vertices with numbers that the header does not declare";

/// Marks a missing colour. Each component also marks a missing number, such as alpha.
inline const Eigen::Vector4d kNoColor =
    Eigen::Vector4d::Constant(std::numeric_limits<double>::quiet_NaN());

/// Converts the colours of a file, in [0, 1] or [0, 255], to [0, 1]. Divides by 255 if a number is
/// clearly above 1. Missing components become 1.
std::vector<Eigen::Vector4f> unit_colors(const std::vector<Eigen::Vector4d>& colors);

/// Ends the polygon whose corners were appended to `faces.vertices`. Throws InputError, at the line
/// of `offset`, when the mesh has more corners than an Index can number.
void close_face(const SourceFile& file, Faces& faces, std::uint64_t offset);

/// Returns the offset of the last line of a text file, ignoring blank lines at its end.
std::uint64_t start_of_last_line(const SourceFile& file);

/// Reports defective faces to SourceFile::report_defect, and removes them from the complete mesh.
class FaceDefects {
 public:
  explicit FaceDefects(SourceFile& file) : file_(file) {}

  /// Reports a defect of `face`. Counts each face once, even if several corners are wrong. The
  /// reader may add any face as a placeholder, because `drop_faces` removes it.
  void report(FileDefectKind kind, std::uint64_t offset, std::size_t face,
              const std::string& message);
  void report_short(std::uint64_t offset, std::size_t face, std::size_t corners);
  /// Reports a corner that refers to `vertex`, which is not a vertex of the file.
  void report_vertex(std::uint64_t offset, std::size_t face, std::int64_t vertex,
                     std::size_t vertex_count);

  /// Removes the reported faces from `mesh`. Call it after the reader has added all faces.
  void drop_faces(Mesh& mesh) const;

 private:
  SourceFile& file_;
  std::vector<std::size_t> faces_;
};

// Each reader returns the mesh, and records the locations of positions and normals in `file`. It
// throws InputError, with the location, if the file is malformed.

Mesh read_obj(SourceFile& file);
Mesh read_off(SourceFile& file);
Mesh read_ply(SourceFile& file);
Mesh read_stl(SourceFile& file);
Mesh read_gltf(SourceFile& file);

}  // namespace lapwing
