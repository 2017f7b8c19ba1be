#pragma once

#include <vector>

#include "lapwing/base/union_find.h"
#include "lapwing/mesh/edges.h"

namespace lapwing {

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
