#pragma once

#include <vector>

#include "lapwing/mesh/edges.h"

namespace lapwing {

/// Unwelded seams: groups of two or more boundary edges whose ends lie at exactly the same two
/// points but are not the same vertices. Each row lists the edges of one group, ascending. Edges of
/// no length, and ends that are not finite, are left out.
/// `first_at_position` is `first_at_same_position(mesh.positions)`. Sorts the boundary edges.
Adjacency find_seams(const Mesh& mesh, const Edges& edges,
                     const std::vector<Index>& first_at_position);

/// For each vertex the smallest of those that it is one with once all edges of each seam are one
/// edge, whatever their number and direction: its own number off the seams. Vertices at one place
/// that no seam joins stay apart. `seams` are those of `find_seams`.
std::vector<Index> joined_at_seams(const Adjacency& seams, const Edges& edges,
                                   const std::vector<Index>& first_at_position);

}  // namespace lapwing
