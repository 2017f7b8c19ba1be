#include "lapwing/io/source_file.h"

#include <span>

#include "lapwing/base/errors.h"
#include "lapwing/io/binary_numbers.h"
#include "lapwing/io/text_scanner.h"

namespace lapwing {
namespace {

constexpr std::string_view kNextStep = "; correct this place or export the file again";

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

void SourceFile::fail_at_line(std::uint64_t offset, const std::string& message) const {
  const std::string_view before = bytes().substr(0, offset);
  std::size_t line = 1;
  for (std::size_t i = 0; i < before.size(); ++i) {
    const bool lone_return =
        before[i] == '\r' && (i + 1 >= bytes().size() || bytes()[i + 1] != '\n');
    if (before[i] == '\n' || lone_return) ++line;
  }
  throw InputError(path_.string() + ":" + std::to_string(line) + ": " + message +
                   std::string(kNextStep));
}

void SourceFile::fail(std::uint64_t offset, const std::string& message) const {
  if (encoding == Encoding::ascii) fail_at_line(offset, message);
  throw InputError(path_.string() + ": byte " + std::to_string(offset) + ": " + message +
                   std::string(kNextStep));
}

}  // namespace lapwing
