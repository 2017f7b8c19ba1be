#pragma once

#include "lapwing/mesh/mesh.h"

namespace lapwing {

/// Finer versions of a triangle mesh: every triangle becomes four. Vertex v of `mesh` stays number
/// v; the vertex on edge e of `build_edges(mesh)` is number vertex_count() + e. Attributes are
/// dropped. Both throw InputError on a face that is no triangle.

/// Throws InputError when subdividing so often would make more than kMostTriangles; each of the
/// two does for its one time.
void require_subdividable(const Mesh& mesh, int times);

/// New vertices at the midpoints of edges: the same shape.
Mesh subdivide(const Mesh& mesh);

/// One step of Loop's scheme: the limit of many is a surface with continuous tangents. Border edges
/// become cubic B-splines of the border alone; so do edges with more than two triangles. A vertex
/// where other than two such edges end stays.
Mesh loop_subdivide(const Mesh& mesh);

}  // namespace lapwing
