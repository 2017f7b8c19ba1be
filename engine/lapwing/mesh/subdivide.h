#pragma once

#include "lapwing/mesh/mesh.h"

namespace lapwing {

/// Finer versions of a triangle mesh: every triangle becomes four. Vertex v of `mesh` stays number
/// v; the vertex on edge e of `build_edges(mesh)` is number vertex_count() + e. Attributes are
/// dropped. Both throw InputError if a face is not a triangle or has a vertex that is not finite.

/// Throws InputError if subdividing `times` times would make more than kMostTriangles. Both
/// functions below check this for their one step.
void require_subdividable(const Mesh& mesh, int times);

/// Adds vertices at the midpoints of edges, which keeps the shape.
Mesh subdivide(const Mesh& mesh);

/// One step of Loop's scheme, whose limit surface has continuous tangents. Border edges, and edges
/// with more than two triangles, become cubic B-splines that depend on such edges alone. A vertex
/// with one or more than two such edges stays.
Mesh loop_subdivide(const Mesh& mesh);

}  // namespace lapwing
