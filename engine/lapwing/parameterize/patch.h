#pragma once

#include <array>
#include <span>
#include <string>
#include <vector>

#include "lapwing/mesh/topology.h"
#include "lapwing/region/vertex_set.h"

namespace lapwing {

/// A disk-shaped part of a mesh with local vertex indices, prepared for a map to the plane. Local
/// indices below `vertices.size()` are vertices of the mesh; the others are midpoints of inner
/// edges that join two boundary vertices. Without the midpoints, such edges could be mapped to the
/// domain's boundary, and triangles to a line.
struct Patch {
  VertexSet vertices;  ///< local index -> vertex of the mesh
  /// (local index - vertices.size()) -> ends of the edge.
  std::vector<std::array<Index, 2>> midpoint_of;
  std::vector<Triangle> triangles;      ///< local indices, oriented as in the mesh
  std::vector<Index> triangle_sources;  ///< per triangle: the triangle of the mesh that contains it
  std::vector<Index> loop;  ///< local indices of the boundary in order, with the patch on its left

  std::size_t size() const { return vertices.size() + midpoint_of.size(); }
  /// Returns the local index of a vertex of the mesh, or kNoIndex. O(log n).
  Index own_number(Index mesh_vertex) const;
};

/// Returns the `values` of mesh vertices by local index. A midpoint gets the mean of its edge's
/// ends.
template <class Value>
std::vector<Value> on_patch(const Patch& patch, std::span<const Value> values) {
  std::vector<Value> own;
  own.reserve(patch.size());
  for (const Index v : patch.vertices) own.push_back(values[v]);
  for (const auto& [a, b] : patch.midpoint_of) own.push_back(Value(0.5 * (own[a] + own[b])));
  return own;
}

/// Returns the mesh vertices of the boundary loop.
VertexSet border_of(const Patch& patch);

/// Returns the patch of the mesh's triangles whose three corners are in `region`. Ignores vertices
/// of the region in none of these triangles; geodesic disks and boxes often have a few at their
/// border. Throws InputError, naming `where`, if a position is not finite or if the triangles do
/// not form a disk. The message then describes the region (region/disk_report.h) and recommends the
/// region form "disk_in" for the largest disk inside. Linear in the mesh.
Patch disk_patch(const VertexSet& region, const Topology& topology,
                 std::span<const Eigen::Vector3d> positions, const std::string& where);

}  // namespace lapwing
