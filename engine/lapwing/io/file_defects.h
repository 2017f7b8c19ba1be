#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace lapwing {

/// Kinds of defects that a mesh file can be read past.
enum class FileDefectKind {
  short_face,      ///< the face is left out
  missing_vertex,  ///< the face, or the triangle of a glTF file, is left out
  wrong_count,     ///< all complete faces are read, and the count in the header is ignored
  missing_end,     ///< of an ascii STL file, which is read to its last complete facet
};
inline constexpr int kFileDefectKindCount = static_cast<int>(FileDefectKind::missing_end) + 1;

/// A kind of defect in words for the user.
struct FileDefectInfo {
  std::string_view name;    ///< plural: "faces with fewer than three corners"
  std::string_view repair;  ///< what reading past it did, as text after the count
};
const FileDefectInfo& describe(FileDefectKind kind);

/// Default limit on the places that a file defect lists.
inline constexpr std::size_t kMaxListedPlaces = 8;

/// The defects of one kind in a file.
struct FileDefect {
  FileDefectKind kind = FileDefectKind::short_face;
  std::size_t count = 0;
  /// The first kMaxListedPlaces, in the order of the file: "line 7: a face needs at least 3
  /// corners, but this one has 2".
  std::vector<std::string> first;
};

// Text for a terminal, as in doctor/format.h.

/// Returns the defects with their first places and the next step.
std::string format(std::span<const FileDefect> defects);
/// Returns one line for each kind: what reading past the defects did.
std::string format_repairs(std::span<const FileDefect> defects);

}  // namespace lapwing
