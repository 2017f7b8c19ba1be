#pragma once

#include <array>
#include <span>
#include <string>
#include <vector>

#include "lapwing/mesh/topology.h"
#include "lapwing/region/vertex_set.h"

namespace lapwing {

/// A disk-shaped part of a mesh with its own vertex numbers, ready to be mapped to the plane. Own
/// numbers below `vertices.size()` are vertices of the mesh; the others are midpoints of inner
/// edges that join two boundary vertices. Such an edge would be mapped to the domain's boundary,
/// and the triangles behind it to a line, so it is halved.
struct Patch {
  VertexSet vertices;                             ///< own number -> vertex of the mesh
  std::vector<std::array<Index, 2>> midpoint_of;  ///< own number - vertices.size() -> ends of edge
  std::vector<Triangle> triangles;                ///< in own numbers, oriented as in the mesh
  std::vector<Index> triangle_sources;            ///< per triangle: the mesh's triangle it lies in
  std::vector<Index> loop;  ///< the boundary in order, in own numbers, with the patch on its left

  std::size_t size() const { return vertices.size() + midpoint_of.size(); }
  /// Returns the own number of a vertex of the mesh, or kNoIndex. O(log n).
  Index own_number(Index mesh_vertex) const;
};

/// Returns `values` of mesh vertices per own number; midpoints get the mean of their edge's ends.
template <class Value>
std::vector<Value> on_patch(const Patch& patch, std::span<const Value> values) {
  std::vector<Value> own;
  own.reserve(patch.size());
  for (const Index v : patch.vertices) own.push_back(values[v]);
  for (const auto& [a, b] : patch.midpoint_of) own.push_back(Value(0.5 * (own[a] + own[b])));
  return own;
}

/// Returns the boundary loop as a set of entries of `vertices`.
VertexSet border_of(const Patch& patch);

/// Returns the patch of the mesh's triangles whose three corners are in `region`. Ignores vertices
/// of the region in none of them: geodesic disks and boxes often have a few at their edge. Throws
/// InputError, naming `where`, if a vertex is not finite or if the rest is not a disk. The message
/// then describes it (pieces, loops, handles, with vertices; region/disk_report.h) and offers the
/// region form "disk_in" for the largest disk inside (region/largest_disk.h). Linear in the mesh.
Patch disk_patch(const VertexSet& region, const Topology& topology,
                 std::span<const Eigen::Vector3d> positions, const std::string& where);

}  // namespace lapwing
