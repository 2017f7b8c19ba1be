#pragma once

#include <span>
#include <vector>

#include "lapwing/mesh/topology.h"
#include "lapwing/region/vertex_set.h"

namespace lapwing {

/// Returns the connected components of `region` along ring edges, ordered by smallest vertex.
/// Vertices with an empty ring belong to none, because only their handle moves them.
std::vector<VertexSet> region_components(const VertexSet& region, const Topology& topology);

/// The triangles with all corners in a set of vertices, with compact vertex numbers ("own").
struct RegionTriangles {
  VertexSet vertices;               ///< own number -> mesh vertex; only vertices of triangles
  VertexSet loose;                  ///< the other vertices of the set
  std::vector<Triangle> triangles;  ///< own numbers, in the mesh's order
  std::vector<Index> sources;       ///< per triangle: its number in the mesh, ascending
};

/// Collects the triangles of `region`. Linear in the size of the mesh.
RegionTriangles region_triangles(const VertexSet& region, const Topology& topology);

/// A region and its ring neighbours as a separate small mesh, so that work on it does not grow with
/// the whole mesh. Numbers keep their order. Vertices of the region have the same rings and
/// triangles as in the mesh, in the same order. Their neighbours outside have only the triangles at
/// the region.
struct Submesh {
  VertexSet vertices;  ///< own number -> mesh vertex: the region and its ring neighbours
  VertexSet region;    ///< the region in own numbers
  Topology topology;   ///< `triangle_faces` are those of the mesh

  /// Returns `values`, one per mesh vertex, in own numbers.
  template <class Value>
  std::vector<Value> own(std::span<const Value> values) const {
    std::vector<Value> result;
    result.reserve(vertices.size());
    for (const Index v : vertices) result.push_back(values[v]);
    return result;
  }
};

/// Builds the submesh. Linear in the region, apart from clearing one number per vertex of the mesh.
Submesh submesh_around(const VertexSet& region, const Topology& topology);

/// Returns the own numbers of `members`, which must be vertices of `submesh`.
VertexSet own_numbers(const Submesh& submesh, const VertexSet& members);

}  // namespace lapwing
