#include "lapwing/io/source_file.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>

#include "lapwing/base/errors.h"
#include "lapwing/io/binary_numbers.h"
#include "lapwing/io/gltf_scene.h"
#include "lapwing/io/text_scanner.h"
#include "lapwing/io/writing.h"

namespace lapwing {

namespace {

constexpr std::string_view kNextStep = "; correct this place or export the file again";
constexpr std::string_view kRepair =
    "; repair the file with `lapwing check MESH --fix OUT`, or export the file again";

std::uint64_t hash_of(std::span<const Index> values, std::uint64_t seed) {
  for (const Index value : values) {
    seed = (seed ^ value) * 0x9E3779B97F4A7C15U;
    seed ^= seed >> 29U;
  }
  return seed;
}

std::uint64_t hash_of_faces(const Mesh& mesh) {
  return hash_of(mesh.face_vertices(), hash_of(mesh.face_starts(), mesh.face_starts().size()));
}

}  // namespace

Eigen::Vector3d SourceFile::read_triple(const NumberTriples& triples, std::size_t record) const {
  Eigen::Vector3d result = Eigen::Vector3d::Zero();
  for (std::size_t k = 0; k < 3; ++k) {
    const char* const begin = bytes().data() + triples.offset(record, k);
    auto& value = result[static_cast<Eigen::Index>(k)];
    if (encoding == Encoding::ascii) {
      parse_number(begin, bytes().data() + bytes().size(), value);
    } else {
      value = load_number(begin, triples.types[k], encoding);
    }
  }
  return result;
}

void SourceFile::remember_topology(const Mesh& mesh) {
  vertex_count_ = mesh.vertex_count();
  topology_hash_ = hash_of_faces(mesh);
}

bool SourceFile::describes(const Mesh& mesh) const {
  return mesh.vertex_count() == vertex_count_ && hash_of_faces(mesh) == topology_hash_;
}

std::size_t SourceFile::line_at(std::uint64_t offset) const {
  const std::string_view before = bytes().substr(0, offset);
  std::size_t line = 1;
  for (std::size_t i = 0; i < before.size(); ++i) {
    const bool lone_return =
        before[i] == '\r' && (i + 1 >= bytes().size() || bytes()[i + 1] != '\n');
    if (before[i] == '\n' || lone_return) ++line;
  }
  return line;
}

FileDefect& SourceFile::counted_defect(FileDefectKind kind) {
  auto defect = std::ranges::find(defects, kind, &FileDefect::kind);
  if (defect == defects.end()) defect = defects.insert(defect, {kind, 0, {}});
  ++defect->count;
  return *defect;
}

void SourceFile::report_defect(FileDefectKind kind, std::uint64_t offset,
                               const std::string& message) {
  const bool is_text = encoding == Encoding::ascii;
  if (!may_be_damaged) {
    const std::string place =
        is_text ? ":" + std::to_string(line_at(offset)) : ": byte " + std::to_string(offset);
    throw InputError(path_.string() + place + ": " + message + std::string(kRepair));
  }
  FileDefect& defect = counted_defect(kind);
  if (defect.first.size() == kMaxListedPlaces) return;
  const std::string place =
      is_text ? "line " + std::to_string(line_at(offset)) : "byte " + std::to_string(offset);
  defect.first.push_back(place + ": " + message);
}

void SourceFile::report_defect(FileDefectKind kind, const std::string& where,
                               const std::string& message) {
  if (!may_be_damaged) throw InputError(where + ": " + message + std::string(kRepair));
  FileDefect& defect = counted_defect(kind);
  if (defect.first.size() < kMaxListedPlaces) defect.first.push_back(where + ": " + message);
}

void SourceFile::fail_at_line(std::uint64_t offset, const std::string& message) const {
  throw InputError(path_.string() + ":" + std::to_string(line_at(offset)) + ": " + message +
                   std::string(kNextStep));
}

void SourceFile::fail(std::uint64_t offset, const std::string& message) const {
  if (encoding == Encoding::ascii) fail_at_line(offset, message);
  throw InputError(path_.string() + ": byte " + std::to_string(offset) + ": " + message +
                   std::string(kNextStep));
}

namespace {

// A NaN coordinate has not moved if it is still NaN.
bool same(double a, double b) {
  return a == b || (std::isnan(a) && std::isnan(b));
}

bool has_integers(const NumberTriples& triples) {
  return std::any_of(triples.types.begin(), triples.types.end(), is_integer);
}

void require_float(double value, const SourceFile& source) {
  if (!std::isfinite(value) || std::abs(value) <= std::numeric_limits<float>::max()) return;
  throw InputError("a coordinate of " + std::to_string(value) +
                   " is beyond the range of the 32-bit floats of " + source.path().string() +
                   "; write another format, or scale the mesh");
}

void set_triple(FilePatch& patch, const SourceFile& source, const NumberTriples& triples,
                std::size_t record, const Eigen::Vector3d& before, const Eigen::Vector3d& now) {
  for (std::size_t k = 0; k < 3; ++k) {
    const auto axis = static_cast<Eigen::Index>(k);
    if (same(before[axis], now[axis])) continue;
    if (triples.types[k] == Scalar::float32) require_float(now[axis], source);
    patch.set_number(triples.offset(record, k), now[axis], triples.types[k]);
  }
}

// Whether the normals of a point cloud differ from its file. Those of a mesh follow its faces.
bool normals_changed(const SourceFile& source, const Mesh& mesh) {
  const std::vector<Eigen::Vector3d>& normals = mesh.attributes().normals;
  if (mesh.face_count() > 0 || normals.size() != source.normals.count) return false;
  for (std::size_t r = 0; r < normals.size(); ++r) {
    if (!are_same(source.read_triple(source.normals, r), normals[r])) return true;
  }
  return false;
}

}  // namespace

bool are_same(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  return same(a.x(), b.x()) && same(a.y(), b.y()) && same(a.z(), b.z());
}

void FilePatch::set_number(std::uint64_t offset, double value, Scalar type) {
  if (encoding_ != Encoding::ascii) {
    return store_number(binary_.data() + offset, value, type, encoding_);
  }
  double ignored = 0.0;
  const char* const begin = old_.data() + offset;
  const char* const end = parse_number(begin, old_.data() + old_.size(), ignored);
  std::string text;
  append_number(text, value, type);
  set_text(offset, static_cast<std::uint64_t>(end - begin), std::move(text));
}

Positions source_positions(const SourceFile& source, const Mesh& mesh) {
  Positions positions(mesh.vertex_count());
  if (source.gltf) {
    for (const GltfRecords& set : source.gltf->records) {
      for (std::size_t k = 0; k < set.count(); ++k) {
        positions[source.gltf->vertex_of_record[set.first_record + k]] =
            source.gltf->position(set, k);
      }
    }
    return positions;
  }
  for (std::size_t r = 0; r < source.positions.count; ++r) {
    positions[source.vertex_of(mesh, r)] = source.read_triple(source.positions, r);
  }
  return positions;
}

std::optional<std::string> patch_source(const SourceFile& source, const Mesh& mesh) {
  FilePatch patch(source.bytes(), source.encoding);
  bool moved = normals_changed(source, mesh);
  for (std::size_t r = 0; r < source.positions.count; ++r) {
    const Eigen::Vector3d before = source.read_triple(source.positions, r);
    const Eigen::Vector3d& now = mesh.positions[source.vertex_of(mesh, r)];
    if (are_same(before, now)) continue;
    set_triple(patch, source, source.positions, r, before, now);
    moved = true;
  }
  if (!moved) return std::string(source.bytes());
  if (has_integers(source.positions)) return std::nullopt;
  if (source.normals.count == 0) return patch.apply();

  if (has_integers(source.normals)) return std::nullopt;
  const StoredNormals updated = updated_normals(mesh, source_positions(source, mesh));
  for (std::size_t r = 0; r < source.normals.count; ++r) {
    set_triple(patch, source, source.normals, r, source.read_triple(source.normals, r),
               updated.normals[r]);
  }
  if (updated.normals.size() > source.normals.count) add_obj_normals(mesh, updated, source, patch);
  return patch.apply();
}

}  // namespace lapwing
