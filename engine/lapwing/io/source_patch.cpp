#include "lapwing/io/source_patch.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "lapwing/base/errors.h"
#include "lapwing/io/binary_numbers.h"
#include "lapwing/io/gltf_layout.h"
#include "lapwing/io/text_scanner.h"
#include "lapwing/io/writing.h"

namespace lapwing {
namespace {

// A NaN coordinate has not moved if it is still NaN.
bool same(double a, double b) {
  return a == b || (std::isnan(a) && std::isnan(b));
}

bool has_integers(const NumberTriples& triples) {
  return std::any_of(triples.types.begin(), triples.types.end(), is_integer);
}

void set_triple(SourcePatch& patch, const NumberTriples& triples, std::size_t record,
                const Eigen::Vector3d& before, const Eigen::Vector3d& now) {
  for (std::size_t k = 0; k < 3; ++k) {
    const auto axis = static_cast<Eigen::Index>(k);
    if (same(before[axis], now[axis])) continue;
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

void SourcePatch::set_number(std::uint64_t offset, double value, Scalar type) {
  if (type == Scalar::float32 && std::abs(value) > std::numeric_limits<float>::max() &&
      std::isfinite(value)) {
    throw InputError("a coordinate of " + std::to_string(value) +
                     " is beyond the range of the 32-bit floats of " + source_.path().string() +
                     "; write another format, or scale the mesh");
  }
  edits_.push_back({offset, value, 0, kNoIndex, type});
}

void SourcePatch::set_text(std::uint64_t offset, std::uint64_t length, std::string text) {
  edits_.push_back({offset, 0.0, length, static_cast<std::uint32_t>(texts_.size()), {}});
  texts_.push_back(std::move(text));
}

std::string SourcePatch::apply() {
  if (source_.encoding != Encoding::ascii) return apply_binary();
  const auto by_offset = [](const Edit& a, const Edit& b) { return a.offset < b.offset; };
  if (!std::is_sorted(edits_.begin(), edits_.end(), by_offset)) {
    std::stable_sort(edits_.begin(), edits_.end(), by_offset);
  }
  return apply_text();
}

std::string SourcePatch::apply_binary() const {
  std::string bytes(source_.bytes());
  for (const Edit& edit : edits_) {
    store_number(bytes.data() + edit.offset, edit.value, edit.type, source_.encoding);
  }
  return bytes;
}

std::string SourcePatch::apply_text() const {
  const std::string_view old = source_.bytes();
  constexpr std::size_t kGrowth = 16;  // a full double is this much longer than a short one
  std::string bytes;
  bytes.reserve(old.size() + kGrowth * edits_.size());
  std::uint64_t copied = 0;
  for (const Edit& edit : edits_) {
    bytes.append(old, copied, edit.offset - copied);
    copied = edit.offset + edit.length;
    if (edit.text != kNoIndex) {
      bytes += texts_[edit.text];
      continue;
    }
    double ignored = 0.0;
    const char* const begin = old.data() + edit.offset;
    copied +=
        static_cast<std::uint64_t>(parse_number(begin, old.data() + old.size(), ignored) - begin);
    append_number(bytes, edit.value, edit.type);
  }
  bytes.append(old, copied);
  return bytes;
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
  SourcePatch patch(source);
  bool moved = normals_changed(source, mesh);
  for (std::size_t r = 0; r < source.positions.count; ++r) {
    const Eigen::Vector3d before = source.read_triple(source.positions, r);
    const Eigen::Vector3d& now = mesh.positions[source.vertex_of(mesh, r)];
    if (are_same(before, now)) continue;
    set_triple(patch, source.positions, r, before, now);
    moved = true;
  }
  if (!moved) return std::string(source.bytes());
  if (has_integers(source.positions)) return std::nullopt;
  if (source.normals.count == 0) return patch.apply();

  if (has_integers(source.normals)) return std::nullopt;
  const StoredNormals updated = updated_normals(mesh, source_positions(source, mesh));
  for (std::size_t r = 0; r < source.normals.count; ++r) {
    set_triple(patch, source.normals, r, source.read_triple(source.normals, r), updated.normals[r]);
  }
  if (updated.normals.size() > source.normals.count) add_obj_normals(mesh, updated, source, patch);
  return patch.apply();
}

}  // namespace lapwing
