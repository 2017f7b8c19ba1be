#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include <Eigen/Core>

#include "lapwing/io/file_bytes.h"
#include "lapwing/io/mesh_format.h"
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
        bytes_(FileBytes::read(path_)) {}
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

  /// Throws InputError "path:line: message; next step" with the line of byte `offset`.
  [[noreturn]] void fail_at_line(std::uint64_t offset, const std::string& message) const;
  /// The same, but with "path: byte offset: ..." if the encoding is binary.
  [[noreturn]] void fail(std::uint64_t offset, const std::string& message) const;

 private:
  std::filesystem::path path_;
  std::string object_;
  MeshFormat format_;
  FileBytes bytes_;
  std::size_t vertex_count_ = 0;
  std::uint64_t topology_hash_ = 0;
};

}  // namespace lapwing
