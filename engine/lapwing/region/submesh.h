#pragma once

#include <span>
#include <vector>

#include "lapwing/mesh/topology.h"
#include "lapwing/region/vertex_set.h"

namespace lapwing {

/// Returns the connected components of `region` along ring edges, ordered by smallest vertex.
/// Vertices with an empty ring belong to no component, because only their handle moves them.
std::vector<VertexSet> region_components(const VertexSet& region, const Topology& topology);

/// The triangles with all corners in a set of vertices, with local vertex indices.
struct RegionTriangles {
  VertexSet vertices;               ///< local index -> mesh vertex; only vertices of triangles
  VertexSet loose;                  ///< the other vertices of the set
  std::vector<Triangle> triangles;  ///< local indices, in the order of the mesh
  std::vector<Index> sources;       ///< per triangle: its index in the mesh, ascending
};

/// Collects the triangles of `region`. Linear in the size of the mesh.
RegionTriangles region_triangles(const VertexSet& region, const Topology& topology);

/// A region and its neighbours as a separate mesh, so that the cost of computations does not depend
/// on the whole mesh. Vertices, and the rings and triangles of vertices of the region, have the
/// same order as in the mesh. Neighbours outside the region have only triangles with a corner in
/// the region.
struct Submesh {
  VertexSet vertices;  ///< local index -> mesh vertex: the region and its neighbours
  VertexSet region;    ///< local indices of the region
  Topology topology;   ///< `triangle_faces` contains faces of the mesh

  /// Returns the entries of `values`, one per mesh vertex, by local index.
  template <class Value>
  std::vector<Value> own(std::span<const Value> values) const {
    std::vector<Value> result;
    result.reserve(vertices.size());
    for (const Index v : vertices) result.push_back(values[v]);
    return result;
  }
};

/// Returns the submesh of `region`. Linear in the region, except that one number per vertex of the
/// mesh is cleared.
Submesh submesh_around(const VertexSet& region, const Topology& topology);

/// Returns the local indices of `members`, which must be vertices of `submesh`.
VertexSet own_numbers(const Submesh& submesh, const VertexSet& members);

}  // namespace lapwing
