#pragma once

#include <cstdint>
#include <limits>
#include <map>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "lapwing/io/source_file.h"
#include "lapwing/mesh/mesh.h"

namespace lapwing {

/// Counts things by name, for MeshAttributes::uneditable.
class Tally {
 public:
  void add(const std::string& name, std::size_t count = 1) { counts_[name] += count; }
  /// Returns lines such as "line elements (6)", sorted by name.
  std::vector<std::string> lines() const;

 private:
  std::map<std::string, std::size_t> counts_;
};

/// Marks a missing colour. Each component also marks a missing number, such as alpha.
inline const Eigen::Vector4d kNoColor =
    Eigen::Vector4d::Constant(std::numeric_limits<double>::quiet_NaN());

/// Converts the colours of a file, in [0, 1] or [0, 255], to [0, 1]. Divides by 255 if a number is
/// clearly above 1. Missing components become 1.
std::vector<Eigen::Vector4f> unit_colors(const std::vector<Eigen::Vector4d>& colors);

/// Ends the polygon whose corners were appended to `faces.vertices`. Throws InputError, at the line
/// of `offset`, when the mesh has more corners than an Index can number.
void close_face(const SourceFile& file, Faces& faces, std::uint64_t offset);

/// Throws InputError: a face (from 0) names a vertex that the file does not have.
[[noreturn]] void fail_vertex(const SourceFile& file, std::uint64_t offset, std::size_t face,
                              std::int64_t vertex, std::size_t vertex_count);

}  // namespace lapwing
