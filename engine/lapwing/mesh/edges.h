#pragma once

#include <array>
#include <span>
#include <string>
#include <vector>

#include "lapwing/base/union_find.h"
#include "lapwing/mesh/mesh.h"
#include "lapwing/mesh/topology.h"

namespace lapwing {

/// The undirected edges of a mesh's polygons (not the diagonals that cut them into triangles), and
/// the polygon sides that lie on each. A side is named by the corner it starts from: side c goes
/// from `face_vertices[c]` to `face_vertices[next_corner[c]]`.
struct Edges {
  std::vector<std::array<Index, 2>> ends;  ///< lower vertex first, ascending
  Adjacency sides;                         ///< the sides on each edge, ascending
  std::vector<Index> edge_of_side;         ///< per corner; kNoIndex for a side from v to v
  std::vector<Index> next_corner;          ///< per corner: the next one in its polygon
  std::vector<Index> face_of_corner;       ///< per corner

  std::size_t count() const { return ends.size(); }
  bool is_boundary(std::size_t edge) const { return sides.size(edge) == 1; }
};

/// Collects the edges of the faces for which `use_face` is not 0. `use_face` has one entry per
/// face, or is empty for all faces. Near-linear time. Requires valid indices (`validate_indices`).
Edges build_edges(const Mesh& mesh, const std::vector<unsigned char>& use_face = {});

/// Returns the name of an edge in messages, such as "12-40".
std::string name_edge(Index a, Index b);

// Side 3 t + k of a list of triangles goes from corner k of triangle t to the next one.

inline Index side_start(std::span<const Triangle> triangles, Index side) {
  return triangles[side / 3][side % 3];
}
inline Index side_end(std::span<const Triangle> triangles, Index side) {
  return triangles[side / 3][(side + 1) % 3];
}

/// Returns the sides on each edge, ascending. Edges are sorted by their lower vertex, then by the
/// other. Near-linear time. No triangle may use a vertex twice.
Adjacency sides_by_edge(std::span<const Triangle> triangles, std::size_t vertex_count);

/// Links the corners of faces that belong to one fan around their vertex. Side c of a face goes
/// from corner c, at vertex `start(c)`, to corner `next(c)`. `sides` lists the sides on each edge.
template <class Start, class Next>
UnionFind linked_fans(const Adjacency& sides, std::size_t corners, const Start& start,
                      const Next& next) {
  UnionFind fans(corners);
  for (std::size_t e = 0; e < sides.row_count(); ++e) {
    const Index first = sides[e][0];
    for (const Index side : sides[e].subspan(1)) {
      const bool same_way = start(side) == start(first);
      fans.unite(first, same_way ? side : next(side));
      fans.unite(next(first), same_way ? next(side) : side);
    }
  }
  return fans;
}

/// Links the fans, each given by a corner, that lie on one boundary loop. A vertex where parts
/// touch counts once per fan.
template <class Fan, class Next>
UnionFind linked_loops(const Adjacency& sides, std::size_t corners, const Fan& fan_of,
                       const Next& next) {
  UnionFind loops(corners);
  for (std::size_t e = 0; e < sides.row_count(); ++e) {
    if (sides.size(e) == 1) loops.unite(fan_of(sides[e][0]), fan_of(next(sides[e][0])));
  }
  return loops;
}

/// The fans of polygons around the vertices: corners of one vertex are in one fan when their
/// polygons are linked through edges at that vertex. A manifold vertex has one fan; a bow-tie
/// vertex has several. An edge with more than two faces links all of them.
struct Fans {
  std::vector<Index> of_corner;         ///< the smallest corner of its fan; kNoIndex off the edges
  std::vector<Index> bow_tie_vertices;  ///< vertices with more than one fan, ascending
};

/// Finds the fans in near-linear time. `edges` must be those of `mesh`.
Fans find_fans(const Mesh& mesh, const Edges& edges);

/// Returns the number of boundary loops. A bow-tie vertex counts once per fan, so two holes that
/// touch at a point are two loops.
std::size_t count_boundary_loops(const Edges& edges, const Fans& fans);

}  // namespace lapwing
