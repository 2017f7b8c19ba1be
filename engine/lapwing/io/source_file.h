#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <Eigen/Core>

#include "lapwing/io/file_bytes.h"
#include "lapwing/io/file_defects.h"
#include "lapwing/io/mesh_format.h"
#include "lapwing/io/stored_normals.h"
#include "lapwing/json/json_text.h"
#include "lapwing/mesh/mesh.h"

namespace lapwing {

/// Locations of the positions or the normals in a file, as records of three numbers.
struct NumberTriples {
  std::size_t count = 0;
  std::array<Scalar, 3> types{Scalar::float64, Scalar::float64, Scalar::float64};
  std::vector<std::uint64_t> offsets;  ///< of each number, three per record; empty when regular
  /// Regular layout: from byte `first`, each block of `stride` bytes holds `per_block` records,
  /// `spacing` bytes apart. Number k of a block's first record is at places[k].
  std::uint64_t first = 0;
  std::uint64_t stride = 0;
  std::uint64_t per_block = 1;
  std::uint64_t spacing = 0;
  std::array<std::uint64_t, 3> places{};

  std::uint64_t offset(std::size_t record, std::size_t k) const {
    if (!offsets.empty()) return offsets[3 * record + k];
    return first + record / per_block * stride + record % per_block * spacing + places[k];
  }
  void add(std::uint64_t x, std::uint64_t y, std::uint64_t z) {
    offsets.insert(offsets.end(), {x, y, z});
    ++count;
  }
};

struct GltfLayout;

/// A file as it was read, with the locations of the numbers that an edit changes. The writer of the
/// same format copies the bytes and replaces only those numbers. Position record i belongs to
/// vertex i, or to corner i in files that repeat vertices at every corner (STL). Normal record i
/// belongs to entry i of MeshAttributes::normals.
class SourceFile {
 public:
  SourceFile(MeshPath name, MeshFormat format)
      : path_(std::move(name.file)),
        object_(std::move(name.object)),
        format_(format),
        bytes_(FileBytes::read_data(path_)) {}
  SourceFile(const SourceFile&) = delete;
  SourceFile& operator=(const SourceFile&) = delete;

  const std::filesystem::path& path() const { return path_; }
  /// Name of the requested object; empty for all objects.
  const std::string& object() const { return object_; }
  MeshFormat format() const { return format_; }
  std::string_view bytes() const { return bytes_.view(); }

  Encoding encoding = Encoding::ascii;
  NumberTriples positions;
  NumberTriples normals;
  bool positions_by_corner = false;
  /// Replaces the three members above for glTF files.
  std::shared_ptr<const GltfLayout> gltf;

  /// Returns the three numbers of a record, as the reader parsed them.
  Eigen::Vector3d read_triple(const NumberTriples& triples, std::size_t record) const;

  /// Returns the vertex of position record `record` in a mesh that this file `describes`.
  std::size_t vertex_of(const Mesh& mesh, std::size_t record) const {
    return positions_by_corner ? mesh.face_vertices()[record] : record;
  }

  /// Stores the connectivity of the file, for `describes`. Called once, by the reader.
  void remember_topology(const Mesh& mesh);
  /// Whether `mesh` still has the vertex count and the faces of the file.
  bool describes(const Mesh& mesh) const;

  /// What the reader left out, and the next step; for the user, in printable lines.
  std::vector<std::string> notes;

  /// If true, the reader skips defects and collects them in `defects`.
  bool may_be_damaged = false;
  std::vector<FileDefect> defects;

  /// Reports a defect at byte `offset` that a reader can skip. If `may_be_damaged` is false, throws
  /// an InputError that names the command to repair the file.
  void report_defect(FileDefectKind kind, std::uint64_t offset, const std::string& message);
  /// Reports a defect in a JSON document. `where` is the result of JsonNode::where.
  void report_defect(FileDefectKind kind, const std::string& where, const std::string& message);

  /// Throws InputError "path:line: message; next step" with the line of byte `offset`.
  [[noreturn]] void fail_at_line(std::uint64_t offset, const std::string& message) const;
  /// The same, but with "path: byte offset: ..." if the encoding is binary.
  [[noreturn]] void fail(std::uint64_t offset, const std::string& message) const;

 private:
  std::size_t line_at(std::uint64_t offset) const;
  FileDefect& counted_defect(FileDefectKind kind);

  std::filesystem::path path_;
  std::string object_;
  MeshFormat format_;
  FileBytes bytes_;
  std::size_t vertex_count_ = 0;
  std::uint64_t topology_hash_ = 0;
};

/// Replaces numbers and text in the bytes of a file. All other bytes stay unchanged.
class FilePatch {
 public:
  /// `bytes` must outlive the patch.
  FilePatch(std::string_view bytes, Encoding encoding)
      : old_(bytes), encoding_(encoding), binary_(encoding == Encoding::ascii ? "" : bytes) {}

  /// Replaces the number at byte `offset`. In a text file, the new number has enough digits to be
  /// read back exactly.
  void set_number(std::uint64_t offset, double value, Scalar type);
  /// Replaces `length` bytes of text, or inserts when `length` is 0.
  void set_text(std::uint64_t offset, std::uint64_t length, std::string text) {
    edits_.replace({offset, offset + length}, std::move(text));
  }
  std::string apply() const {
    return encoding_ == Encoding::ascii ? edits_.applied_to(old_) : binary_;
  }

 private:
  std::string_view old_;
  Encoding encoding_;
  std::string binary_;
  TextEdits edits_;
};

/// Whether two positions are equal; NaN equals NaN.
bool are_same(const Eigen::Vector3d& a, const Eigen::Vector3d& b);

/// Returns the bytes of `source` with the positions of `mesh`, which it `describes`, and matching
/// normals; nullopt if it cannot store them (moved coordinates in a file of integers).
std::optional<std::string> patch_source(const SourceFile& source, const Mesh& mesh);

/// Returns the positions in the file, per vertex.
Positions source_positions(const SourceFile& source, const Mesh& mesh);

/// Adds the new normals of `updated` after the last normal of an OBJ file, and updates the indices
/// of face corners. Implemented in obj_file.cpp.
void add_obj_normals(const Mesh& mesh, const StoredNormals& updated, const SourceFile& source,
                     FilePatch& patch);

}  // namespace lapwing
