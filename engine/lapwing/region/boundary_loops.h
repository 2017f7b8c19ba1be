#pragma once

#include <span>
#include <string>
#include <vector>

#include "lapwing/mesh/topology.h"

namespace lapwing {

/// A closed curve of boundary edges: its vertices in order, each once, with the surface on the
/// left.
using BoundaryLoop = std::vector<Index>;

/// Returns the boundary loops of a mesh, sorted by smallest vertex, each starting at it. A closed
/// mesh has none. Throws InputError, naming `where` and the vertices, if the boundary touches
/// itself at a vertex. Also throws it if the boundary ends at an edge with more than two triangles
/// or with two that face opposite ways; such edges elsewhere do no harm. Near-linear time.
std::vector<BoundaryLoop> boundary_loops(std::span<const Triangle> triangles,
                                         const std::string& where);
/// The same, if the result of `sides_by_edge` is already known.
std::vector<BoundaryLoop> boundary_loops(std::span<const Triangle> triangles,
                                         const Adjacency& sides, const std::string& where);

/// Returns vertices - edges + triangles, counting only vertices in a triangle. `sides` lists the
/// sides on each edge.
long euler_characteristic(std::span<const Triangle> triangles, const Adjacency& sides);

}  // namespace lapwing
