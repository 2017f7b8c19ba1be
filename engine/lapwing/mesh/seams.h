#pragma once

#include <vector>

#include "lapwing/mesh/edges.h"

namespace lapwing {

/// Finds unwelded seams: groups of two or more boundary edges whose ends lie at exactly the same
/// two points but are different vertices. Each row lists the edges of one group, ascending. Skips
/// edges of zero length and edges with ends that are not finite. `first_at_position` is
/// `first_at_same_position(mesh.positions)`. Sorts the boundary edges.
Adjacency find_seams(const Mesh& mesh, const Edges& edges,
                     const std::vector<Index>& first_at_position);

/// Joins all edges of each seam into one edge, whatever their number and direction. Returns the
/// smallest vertex that each vertex is joined to, which off the seams is itself. Vertices at one
/// point that no seam joins stay separate. `seams` is the result of `find_seams`.
std::vector<Index> joined_at_seams(const Adjacency& seams, const Edges& edges,
                                   const std::vector<Index>& first_at_position);

}  // namespace lapwing
