#pragma once

#include <array>
#include <span>
#include <string>
#include <vector>

#include "lapwing/mesh/topology.h"
#include "lapwing/region/vertex_set.h"

namespace lapwing {

/// A part of a mesh that is homeomorphic to a disk, in numbers of its own, ready to be laid into
/// the plane. Own numbers below `vertices.size()` are vertices of the mesh; the others are
/// midpoints of edges that join two boundary vertices through the inside. Such an edge would be
/// laid onto the domain's boundary, and the triangles behind it onto a line, so it is halved.
struct Patch {
  VertexSet vertices;                             ///< own number -> vertex of the mesh
  std::vector<std::array<Index, 2>> midpoint_of;  ///< own number - vertices.size() -> two own ones
  std::vector<Triangle> triangles;                ///< own numbers, oriented as in the mesh
  std::vector<Index> triangle_sources;            ///< per triangle: the mesh's triangle it lies in
  std::vector<Index> loop;  ///< the boundary, own numbers, in order, the patch on its left

  std::size_t size() const { return vertices.size() + midpoint_of.size(); }
  /// The own number of a vertex of the mesh, or kNoIndex. O(log n).
  Index own_number(Index mesh_vertex) const;
};

/// `values`, one per vertex of the mesh, per own number of the patch.
template <class Value>
std::vector<Value> on_patch(const Patch& patch, std::span<const Value> values) {
  std::vector<Value> own;
  own.reserve(patch.size());
  for (const Index v : patch.vertices) own.push_back(values[v]);
  for (const auto& [a, b] : patch.midpoint_of) own.push_back(Value(0.5 * (own[a] + own[b])));
  return own;
}

/// The boundary loop as a set, in the numbers of `vertices`.
VertexSet border_of(const Patch& patch);

/// The patch of the mesh's triangles whose three corners are in `region`. Vertices of the region in
/// none of them are left out silently: geodesic disks and boxes often have a few at their edge.
/// Throws InputError, naming `where`, when the rest is no disk; the message says what it is
/// (pieces, loops, handles, with vertices; see region/disk_report.h) and offers the region form
/// "disk_in" for the largest disk inside (see region/largest_disk.h). Also when a vertex is not
/// finite. Linear in the size of the mesh.
Patch disk_patch(const VertexSet& region, const Topology& topology,
                 std::span<const Eigen::Vector3d> positions, const std::string& where);

}  // namespace lapwing
