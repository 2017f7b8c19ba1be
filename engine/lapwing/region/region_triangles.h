#pragma once

#include <vector>

#include "lapwing/mesh/topology.h"
#include "lapwing/region/vertex_set.h"

namespace lapwing {

/// The triangles that a set of vertices holds whole, in numbers of their own.
struct RegionTriangles {
  VertexSet vertices;               ///< own number -> vertex of the mesh; those of a triangle only
  VertexSet loose;                  ///< the others of the set
  std::vector<Triangle> triangles;  ///< own numbers, in the mesh's order
  std::vector<Index> sources;       ///< per triangle: its number in the mesh, ascending
};

/// Linear in the size of the mesh.
RegionTriangles region_triangles(const VertexSet& region, const Topology& topology);

}  // namespace lapwing
