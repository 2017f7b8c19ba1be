#include "lapwing/mesh/edges.h"

#include <algorithm>
#include <cstdint>

#include "lapwing/base/cancellation.h"

namespace lapwing {

namespace {

// Returns the sides on each edge in ascending order. The edges are sorted by their lower vertex,
// then by their higher vertex. `ends(side)` returns the lower and the higher vertex of a side.
// Skips sides whose two vertices are equal.
template <class Ends>
Adjacency grouped_sides(std::size_t side_count, std::size_t vertex_count, const Ends& ends) {
  // Counting sort by the lower end, then a sort by the other end and the side's number.
  std::vector<Index> starts(vertex_count + 1, 0);
  for (Index side = 0; side < side_count; ++side) {
    const auto [low, high] = ends(side);
    if (low != high) ++starts[low + 1];
  }
  for (std::size_t v = 0; v < vertex_count; ++v) starts[v + 1] += starts[v];
  std::vector<std::uint64_t> sorted(starts.back());
  std::vector<Index> next(starts.begin(), starts.end() - 1);
  for (Index side = 0; side < side_count; ++side) {
    const auto [low, high] = ends(side);
    if (low != high) sorted[next[low]++] = std::uint64_t{high} << 32 | side;
  }
  Adjacency edges;
  edges.starts.reserve(sorted.size() / 2 + 2);
  edges.values.reserve(sorted.size());
  CancelCheck cancel_check;
  for (std::size_t v = 0; v < vertex_count; ++v) {
    cancel_check();
    std::sort(sorted.begin() + starts[v], sorted.begin() + starts[v + 1]);
    for (Index at = starts[v]; at < starts[v + 1]; ++at) {
      if (at > starts[v] && sorted[at] >> 32 != sorted[at - 1] >> 32) edges.starts.push_back(at);
      edges.values.push_back(static_cast<Index>(sorted[at]));
    }
    if (starts[v + 1] > starts[v]) edges.starts.push_back(starts[v + 1]);
  }
  return edges;
}

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
  const std::vector<Index>& vertex_of = mesh.face_vertices();
  const auto ends = [&](Index side) {
    const bool is_used = use_face.empty() || use_face[edges.face_of_corner[side]] != 0;
    const Index start = vertex_of[side];
    return std::minmax({start, is_used ? vertex_of[edges.next_corner[side]] : start});
  };
  edges.sides = grouped_sides(vertex_of.size(), mesh.vertex_count(), ends);
  edges.edge_of_side.assign(vertex_of.size(), kNoIndex);
  edges.ends.reserve(edges.sides.row_count());
  for (std::size_t e = 0; e < edges.sides.row_count(); ++e) {
    const auto [low, high] = ends(edges.sides[e][0]);
    edges.ends.push_back({low, high});
    for (const Index side : edges.sides[e]) edges.edge_of_side[side] = static_cast<Index>(e);
  }
  return edges;
}

std::string name_edge(Index a, Index b) {
  return std::to_string(a) + "-" + std::to_string(b);
}

Adjacency sides_by_edge(std::span<const Triangle> triangles, std::size_t vertex_count) {
  return grouped_sides(3 * triangles.size(), vertex_count, [&](Index side) {
    return std::minmax({side_start(triangles, side), side_end(triangles, side)});
  });
}

Fans find_fans(const Mesh& mesh, const Edges& edges) {
  const std::vector<Index>& vertex_of = mesh.face_vertices();
  UnionFind sets = linked_fans(
      edges.sides, vertex_of.size(), [&](Index c) { return vertex_of[c]; },
      [&](Index c) { return edges.next_corner[c]; });
  // The two corners of a side from a vertex to itself belong together.
  for (Index c = 0; c < vertex_of.size(); ++c) {
    const Index next = edges.next_corner[c];
    if (vertex_of[c] == vertex_of[next]) sets.unite(c, next);
  }
  Fans fans;
  fans.of_corner.assign(vertex_of.size(), kNoIndex);
  std::vector<Index> first_fan(mesh.vertex_count(), kNoIndex);
  std::vector<unsigned char> is_bow_tie(mesh.vertex_count(), 0);
  const auto add_corner = [&](Index c) {
    const Index fan = sets.find(c);
    Index& known = first_fan[vertex_of[c]];
    fans.of_corner[c] = fan;
    if (known == kNoIndex) known = fan;
    if (known != fan) is_bow_tie[vertex_of[c]] = 1;
  };
  CancelCheck cancel_check;
  for (Index c = 0; c < vertex_of.size(); ++c) {
    cancel_check();
    if (edges.edge_of_side[c] == kNoIndex) continue;
    add_corner(c);
    add_corner(edges.next_corner[c]);
  }
  for (std::size_t v = 0; v < is_bow_tie.size(); ++v) {
    cancel_check();
    if (is_bow_tie[v]) fans.bow_tie_vertices.push_back(static_cast<Index>(v));
  }
  return fans;
}

std::size_t count_boundary_loops(const Edges& edges, const Fans& fans) {
  const auto fan_of = [&](Index c) { return fans.of_corner[c]; };
  UnionFind loops = linked_loops(edges.sides, fans.of_corner.size(), fan_of,
                                 [&](Index c) { return edges.next_corner[c]; });
  std::vector<char> found(fans.of_corner.size(), 0);
  for (std::size_t e = 0; e < edges.count(); ++e) {
    if (edges.is_boundary(e)) found[loops.find(fan_of(edges.sides[e][0]))] = 1;
  }
  return static_cast<std::size_t>(std::count(found.begin(), found.end(), 1));
}

}  // namespace lapwing
