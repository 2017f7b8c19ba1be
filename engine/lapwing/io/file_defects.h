#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace lapwing {

/// Kinds of defects in a mesh file that the reader can skip or correct.
enum class FileDefectKind {
  short_face,      ///< the reader leaves out the face
  missing_vertex,  ///< the reader leaves out the face or, in a glTF file, the triangle
  wrong_count,     ///< the reader ignores the count in the header and reads all faces
  missing_end,     ///< the reader reads an ascii STL file up to its last complete facet
};
inline constexpr int kFileDefectKindCount = static_cast<int>(FileDefectKind::missing_end) + 1;

/// A kind of defect in words for the user.
struct FileDefectInfo {
  std::string_view name;    ///< plural: "faces with fewer than three corners"
  std::string_view repair;  ///< follows a count: "faces with fewer than three corners left out"
};
const FileDefectInfo& describe(FileDefectKind kind);

/// By default, a FileDefect lists at most this many places.
inline constexpr std::size_t kMaxListedPlaces = 8;

/// All defects of one kind in a file.
struct FileDefect {
  FileDefectKind kind = FileDefectKind::short_face;
  std::size_t count = 0;
  /// The first places, in the order of the file, such as "line 7: a face needs at least 3 corners,
  /// but this one has 2".
  std::vector<std::string> first;
};

// These functions return text for a terminal, like those in doctor/format.h.

/// Lists the defects with their first places, and tells the user what to do next.
std::string format(std::span<const FileDefect> defects);
/// Lists what the reader did, in one line for each kind of defect.
std::string format_repairs(std::span<const FileDefect> defects);

}  // namespace lapwing
