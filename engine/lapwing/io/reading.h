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
  /// "line elements (6)", by name.
  std::vector<std::string> lines() const;

 private:
  std::map<std::string, std::size_t> counts_;
};

/// Where a file gives no colour, or no alpha.
inline const Eigen::Vector4d kNoColor =
    Eigen::Vector4d::Constant(std::numeric_limits<double>::quiet_NaN());

/// Colours in [0, 1] from the numbers of a file, which are in [0, 1] or in [0, 255]: divided by 255
/// when one is clearly above 1. What the file does not give is 1.
std::vector<Eigen::Vector4f> unit_colors(const std::vector<Eigen::Vector4d>& colors);

/// Ends the polygon whose corners were appended to `faces.vertices`. Throws InputError, at the line
/// of `offset`, when the mesh has more corners than an Index can number.
void close_face(const SourceFile& file, Faces& faces, std::uint64_t offset);

/// Throws InputError: a face (from 0) names a vertex that the file does not have.
[[noreturn]] void fail_vertex(const SourceFile& file, std::uint64_t offset, std::size_t face,
                              std::int64_t vertex, std::size_t vertex_count);

}  // namespace lapwing
