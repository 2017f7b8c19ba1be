#pragma once

#include <span>
#include <string>
#include <vector>

#include "lapwing/mesh/topology.h"

namespace lapwing {

/// A closed curve of boundary edges: vertices in order, the surface on its left, each named once.
using BoundaryLoop = std::vector<Index>;

/// The boundary loops of a mesh, each from its smallest vertex on, by smallest vertex; none of a
/// closed one. Throws InputError, naming `where` and the vertices, where the boundary is no set of
/// loops: it touches itself at a vertex, or ends at an edge with more than two triangles or with
/// two that face opposite ways. Such edges elsewhere do not matter. Near-linear.
std::vector<BoundaryLoop> boundary_loops(std::span<const Triangle> triangles,
                                         const std::string& where);
/// The same where `sides_by_edge` of the triangles is there already.
std::vector<BoundaryLoop> boundary_loops(std::span<const Triangle> triangles,
                                         const Adjacency& sides, const std::string& where);

/// The sides of one edge each: vertices - edges + triangles, of the vertices in a triangle.
long euler_characteristic(std::span<const Triangle> triangles, const Adjacency& sides);

}  // namespace lapwing
