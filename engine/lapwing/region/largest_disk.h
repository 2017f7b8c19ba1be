#pragma once

#include <span>

#include "lapwing/mesh/topology.h"
#include "lapwing/region/vertex_set.h"

namespace lapwing {

/// Returns the largest disk inside `region` that region growing finds: vertices whose triangles
/// (those with all three corners among them) form a disk and contain them all. Growth starts at the
/// triangle of the largest piece that is farthest from the piece's boundary. Vertices join in the
/// order of their geodesic distance if the triangles that they add keep the whole a disk. A region
/// that is a disk is returned whole, without its vertices in no triangle. A region without
/// triangles gives an empty set. O(n log n), plus work linear in the mesh.
VertexSet largest_disk(const VertexSet& region, const Topology& topology,
                       std::span<const Eigen::Vector3d> positions);

}  // namespace lapwing
