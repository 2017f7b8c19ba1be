#include "lapwing/doctor/repeated_faces.h"

#include <algorithm>
#include <cstdint>
#include <utility>

#include "lapwing/base/cancellation.h"

namespace lapwing {
namespace {

// Sums a hash of each vertex (the finalizer of SplitMix64), so that their order does not matter.
std::uint64_t hash_of_vertices(std::span<const Index> face) {
  std::uint64_t sum = face.size();
  for (const Index v : face) {
    std::uint64_t bits = (v + 1) * 0x9E3779B97F4A7C15ULL;
    bits = (bits ^ (bits >> 30)) * 0xBF58476D1CE4E5B9ULL;
    bits = (bits ^ (bits >> 27)) * 0x94D049BB133111EBULL;
    sum += bits ^ (bits >> 31);
  }
  return sum;
}

std::vector<Index> sorted_vertices(std::span<const Index> face) {
  std::vector<Index> vertices(face.begin(), face.end());
  std::ranges::sort(vertices);
  return vertices;
}

}  // namespace

std::vector<Index> find_repeated_faces(const Mesh& mesh) {
  std::vector<std::pair<std::uint64_t, Index>> hashes;
  hashes.reserve(mesh.face_count());
  CancelCheck cancel_check;
  for (std::size_t f = 0; f < mesh.face_count(); ++f) {
    cancel_check();
    if (!mesh.face(f).empty()) {
      hashes.emplace_back(hash_of_vertices(mesh.face(f)), static_cast<Index>(f));
    }
  }
  std::ranges::sort(hashes);
  std::vector<Index> repeated;
  std::vector<std::vector<Index>> distinct;  // the vertex sets of the current hash
  for (std::size_t i = 0; i < hashes.size(); ++i) {
    cancel_check();
    const bool first_of_hash = i == 0 || hashes[i].first != hashes[i - 1].first;
    const bool last_of_hash = i + 1 == hashes.size() || hashes[i].first != hashes[i + 1].first;
    if (first_of_hash) distinct.clear();
    if (first_of_hash && last_of_hash) continue;
    std::vector<Index> vertices = sorted_vertices(mesh.face(hashes[i].second));
    if (std::ranges::find(distinct, vertices) != distinct.end()) {
      repeated.push_back(hashes[i].second);
    } else {
      distinct.push_back(std::move(vertices));
    }
  }
  std::ranges::sort(repeated);
  return repeated;
}

}  // namespace lapwing
