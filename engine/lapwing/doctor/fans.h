#pragma once

#include <vector>

#include "lapwing/mesh/edges.h"

namespace lapwing {

/// The fans of polygons around the vertices: corners of one vertex are in one fan when their
/// polygons are linked through edges at that vertex. A manifold vertex has one fan; a bow-tie
/// vertex has several. An edge with more than two faces links all of them.
struct Fans {
  std::vector<Index> of_corner;         ///< the smallest corner of its fan; kNoIndex off the edges
  std::vector<Index> bow_tie_vertices;  ///< vertices with more than one fan, ascending
};

/// Near-linear. `edges` are those of `mesh`.
Fans find_fans(const Mesh& mesh, const Edges& edges);

/// Number of boundary loops, where a bow-tie vertex counts as one vertex per fan: two holes that
/// touch at a point are two loops.
std::size_t count_boundary_loops(const Edges& edges, const Fans& fans);

}  // namespace lapwing
