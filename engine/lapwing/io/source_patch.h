#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "lapwing/io/source_file.h"
#include "lapwing/io/stored_normals.h"

namespace lapwing {

/// Collects replacements in the bytes of a file.
class SourcePatch {
 public:
  explicit SourcePatch(const SourceFile& source) : source_(source) {}

  /// Replaces one number, in the type the file declares. Throws InputError when a finite number is
  /// too large for that type.
  void set_number(std::uint64_t offset, double value, Scalar type);
  /// Replaces `length` bytes of text, or inserts when `length` is 0.
  void set_text(std::uint64_t offset, std::uint64_t length, std::string text);

  /// The patched bytes. O(bytes + replacements).
  std::string apply();

 private:
  struct Edit {
    std::uint64_t offset;
    double value;
    std::uint64_t length;  // of text; that of a number is found by parsing
    std::uint32_t text;    // into texts_, kNoIndex for a number
    Scalar type;
  };

  std::string apply_binary() const;
  std::string apply_text() const;

  const SourceFile& source_;
  std::vector<Edit> edits_;
  std::vector<std::string> texts_;
};

/// Whether two positions are equal; NaN equals NaN.
bool are_same(const Eigen::Vector3d& a, const Eigen::Vector3d& b);

/// Returns the bytes of `source` with the positions of `mesh`, which it `describes`, and matching
/// normals; nullopt if it cannot store them (moved coordinates in a file of integers).
std::optional<std::string> patch_source(const SourceFile& source, const Mesh& mesh);

/// Returns the positions in the file, per vertex.
Positions source_positions(const SourceFile& source, const Mesh& mesh);

/// Adds the normals that `updated` has beyond those of an OBJ file behind the last of them, and
/// updates the indices of face corners. (In obj_patch.cpp.)
void add_obj_normals(const Mesh& mesh, const StoredNormals& updated, const SourceFile& source,
                     SourcePatch& patch);

}  // namespace lapwing
