#pragma once

#include <span>
#include <vector>

#include "lapwing/mesh/topology.h"
#include "lapwing/region/vertex_set.h"

namespace lapwing {

/// What the vertices of a region see of their mesh, as a small mesh of its own: work on it does not
/// grow with the mesh around. Numbers keep their order, so vertices of the region have the rings
/// and triangles of the mesh, in its order; their neighbours outside have only what lies within.
struct Submesh {
  VertexSet vertices;  ///< own number -> vertex of the mesh: the region and its ring neighbours
  VertexSet region;    ///< the region in own numbers
  Topology topology;   ///< `triangle_faces` are those of the mesh

  /// `values`, one per vertex of the mesh, per own number.
  template <class Value>
  std::vector<Value> own(std::span<const Value> values) const {
    std::vector<Value> result;
    result.reserve(vertices.size());
    for (const Index v : vertices) result.push_back(values[v]);
    return result;
  }
};

/// Linear in the region, beside clearing one number per vertex of the mesh.
Submesh submesh_around(const VertexSet& region, const Topology& topology);

/// The own numbers of `members`, which are among the vertices of `submesh`.
VertexSet own_numbers(const Submesh& submesh, const VertexSet& members);

}  // namespace lapwing
