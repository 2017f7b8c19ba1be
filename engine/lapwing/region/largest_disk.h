#pragma once

#include <span>

#include "lapwing/mesh/topology.h"
#include "lapwing/region/vertex_set.h"

namespace lapwing {

/// The largest disk inside `region` that growing finds: vertices of it whose triangles (those with
/// all three corners among them) are a disk, each vertex in one. From the triangle of the largest
/// piece that lies farthest from the piece's boundary, vertices join in the order of their geodesic
/// distance, each only where the triangles that come with it keep the whole a disk. A region that
/// is a disk comes back whole, less its vertices in no triangle; one without triangles gives none.
/// O(n log n) beside work linear in the mesh.
VertexSet largest_disk(const VertexSet& region, const Topology& topology,
                       std::span<const Eigen::Vector3d> positions);

}  // namespace lapwing
