#pragma once

#include <span>
#include <vector>

#include "lapwing/mesh/topology.h"
#include "lapwing/region/vertex_set.h"

namespace lapwing {

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
