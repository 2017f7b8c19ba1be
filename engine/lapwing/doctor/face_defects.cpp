#include "lapwing/doctor/face_defects.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <numeric>
#include <utility>
#include <vector>

#include "lapwing/base/cancellation.h"
#include "lapwing/mesh/topology.h"

namespace lapwing {

namespace {

std::vector<Index> vertices_of(const Mesh& mesh, std::span<const Index> corners) {
  std::vector<Index> vertices;
  vertices.reserve(corners.size());
  for (const Index c : corners) vertices.push_back(mesh.face_vertices()[c]);
  return vertices;
}

// Returns the corners of face f without corners that have the same vertex as the previous corner.
std::vector<Index> without_successive_repeats(const Mesh& mesh, std::size_t f) {
  const std::vector<Index>& vertex_of = mesh.face_vertices();
  std::vector<Index> corners;
  for (Index c = mesh.face_starts()[f]; c < mesh.face_starts()[f + 1]; ++c) {
    if (corners.empty() || vertex_of[corners.back()] != vertex_of[c]) corners.push_back(c);
  }
  while (corners.size() > 1 && vertex_of[corners.back()] == vertex_of[corners.front()]) {
    corners.pop_back();
  }
  return corners;
}

void add_face(FaceSources& sources, std::size_t face, std::span<const Index> corners) {
  sources.faces.push_back(static_cast<Index>(face));
  sources.corners.insert(sources.corners.end(), corners.begin(), corners.end());
  sources.starts.push_back(static_cast<Index>(sources.corners.size()));
}

// Adds the non-degenerate triangles of the polygon.
void add_triangles(const Mesh& mesh, std::size_t face, std::span<const Index> corners,
                   FaceSources& sources) {
  Positions positions;
  for (const Index c : corners) positions.push_back(mesh.positions[mesh.face_vertices()[c]]);
  std::vector<Index> polygon(corners.size());
  std::iota(polygon.begin(), polygon.end(), Index{0});
  std::vector<Triangle> triangles;
  triangulate_polygon(polygon, positions, triangles);
  for (const auto& [a, b, c] : triangles) {
    const std::array<Index, 3> triangle{corners[a], corners[b], corners[c]};
    if (!is_degenerate(vertices_of(mesh, triangle))) add_face(sources, face, triangle);
  }
}

}  // namespace

bool is_degenerate(std::span<const Index> polygon) {
  const std::size_t n = polygon.size();
  if (n < 3) return true;
  if (n == 3) {
    return polygon[0] == polygon[1] || polygon[1] == polygon[2] || polygon[2] == polygon[0];
  }
  std::vector<Index> vertices(polygon.begin(), polygon.end());
  std::ranges::sort(vertices);
  return std::ranges::adjacent_find(vertices) != vertices.end();
}

MendedFaces mend_faces(const Mesh& mesh) {
  MendedFaces result;
  std::vector<Index> corners(mesh.face_vertices().size());
  std::iota(corners.begin(), corners.end(), Index{0});
  CancelCheck cancel_check;
  for (std::size_t f = 0; f < mesh.face_count(); ++f) {
    cancel_check();
    if (!is_degenerate(mesh.face(f))) {
      add_face(result.sources, f,
               std::span(corners).subspan(mesh.face_starts()[f], mesh.face(f).size()));
      continue;
    }
    const std::size_t faces_before = result.sources.faces.size();
    const std::vector<Index> kept = without_successive_repeats(mesh, f);
    if (!is_degenerate(vertices_of(mesh, kept))) {
      add_face(result.sources, f, kept);
    } else {
      add_triangles(mesh, f, kept, result.sources);
    }
    ++(result.sources.faces.size() > faces_before ? result.mended : result.removed);
  }
  return result;
}

namespace {

// Sums a hash of each vertex (the finalizer of SplitMix64), so that the result does not depend on
// the order.
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
  std::vector<std::vector<Index>> distinct;  // the different vertex sets with the current hash
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
