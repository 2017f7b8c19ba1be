#include "lapwing/mesh/edges.h"

#include <algorithm>

#include "lapwing/base/cancellation.h"

namespace lapwing {
namespace {

struct Side {
  Index high;
  Index corner;
  auto operator<=>(const Side&) const = default;
};

void link_corners(const Mesh& mesh, Edges& edges) {
  edges.next_corner.resize(mesh.face_vertices().size());
  edges.face_of_corner.resize(mesh.face_vertices().size());
  for (std::size_t f = 0; f < mesh.face_count(); ++f) {
    const Index begin = mesh.face_starts()[f];
    const Index end = mesh.face_starts()[f + 1];
    for (Index c = begin; c < end; ++c) {
      edges.next_corner[c] = c + 1 < end ? c + 1 : begin;
      edges.face_of_corner[c] = static_cast<Index>(f);
    }
  }
}

}  // namespace

Edges build_edges(const Mesh& mesh, const std::vector<unsigned char>& use_face) {
  Edges edges;
  link_corners(mesh, edges);
  const auto is_side = [&](std::size_t c) {
    return mesh.face_vertices()[c] != mesh.face_vertices()[edges.next_corner[c]] &&
           (use_face.empty() || use_face[edges.face_of_corner[c]]);
  };
  const std::size_t corner_count = mesh.face_vertices().size();
  // Group the sides by their lower vertex, then sort within each small group.
  std::vector<Index> starts(mesh.vertex_count() + 1, 0);
  for (std::size_t c = 0; c < corner_count; ++c) {
    if (!is_side(c)) continue;
    ++starts[std::min(mesh.face_vertices()[c], mesh.face_vertices()[edges.next_corner[c]]) + 1];
  }
  for (std::size_t v = 0; v < mesh.vertex_count(); ++v) starts[v + 1] += starts[v];
  std::vector<Side> sides(starts.back());
  std::vector<Index> next(starts.begin(), starts.end() - 1);
  for (std::size_t c = 0; c < corner_count; ++c) {
    if (!is_side(c)) continue;
    const auto [low, high] =
        std::minmax(mesh.face_vertices()[c], mesh.face_vertices()[edges.next_corner[c]]);
    sides[next[low]++] = {high, static_cast<Index>(c)};
  }

  edges.edge_of_side.assign(corner_count, kNoIndex);
  edges.sides.values.reserve(sides.size());
  CancelCheck cancel_check;
  for (std::size_t low = 0; low < mesh.vertex_count(); ++low) {
    cancel_check();
    std::sort(sides.begin() + starts[low], sides.begin() + starts[low + 1]);
    for (Index s = starts[low]; s < starts[low + 1]; ++s) {
      if (s == starts[low] || sides[s].high != sides[s - 1].high) {
        edges.ends.push_back({static_cast<Index>(low), sides[s].high});
        edges.sides.starts.push_back(edges.sides.starts.back());
      }
      ++edges.sides.starts.back();
      edges.sides.values.push_back(sides[s].corner);
      edges.edge_of_side[sides[s].corner] = static_cast<Index>(edges.count() - 1);
    }
  }
  return edges;
}

std::string name_edge(Index a, Index b) {
  return std::to_string(a) + "-" + std::to_string(b);
}

}  // namespace lapwing
