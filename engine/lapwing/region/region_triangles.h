#pragma once

#include <vector>

#include "lapwing/mesh/topology.h"
#include "lapwing/region/vertex_set.h"

namespace lapwing {

/// The triangles with all corners in a set of vertices, with compact vertex numbers ("own").
struct RegionTriangles {
  VertexSet vertices;               ///< own number -> mesh vertex; only vertices of triangles
  VertexSet loose;                  ///< the other vertices of the set
  std::vector<Triangle> triangles;  ///< own numbers, in the mesh's order
  std::vector<Index> sources;       ///< per triangle: its number in the mesh, ascending
};

/// Collects the triangles of `region`. Linear in the size of the mesh.
RegionTriangles region_triangles(const VertexSet& region, const Topology& topology);

}  // namespace lapwing
