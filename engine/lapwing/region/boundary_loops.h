#pragma once

#include <span>
#include <string>
#include <vector>

#include "lapwing/mesh/topology.h"

namespace lapwing {

/// The vertices of a closed curve of boundary edges in order, each once, with the surface on the
/// left.
using BoundaryLoop = std::vector<Index>;

/// Returns the boundary loops of a mesh. Each loop starts at its smallest vertex, and loops are
/// sorted by this vertex. A closed mesh has none. Throws InputError, naming `where` and the
/// vertices, if the boundary touches itself at a vertex, or if it ends at an edge that is
/// non-manifold or inconsistently oriented; such edges elsewhere are ignored. Near-linear time.
std::vector<BoundaryLoop> boundary_loops(std::span<const Triangle> triangles,
                                         const std::string& where);
/// Overload with `sides`, the result of `sides_by_edge`.
std::vector<BoundaryLoop> boundary_loops(std::span<const Triangle> triangles,
                                         const Adjacency& sides, const std::string& where);

/// Returns vertices - edges + triangles, where only vertices of triangles are counted. `sides` is
/// the result of `sides_by_edge`.
long euler_characteristic(std::span<const Triangle> triangles, const Adjacency& sides);

}  // namespace lapwing
