#pragma once

#include <span>

#include "lapwing/mesh/topology.h"
#include "lapwing/region/vertex_set.h"

namespace lapwing {

/// Returns the largest disk inside `region` that region growing finds: a set of vertices whose
/// triangles (with all three corners in the set) contain them all and form a disk. Growth starts at
/// the triangle of the largest component that is farthest from the component's boundary. Vertices
/// are added in the order of their geodesic distance, if the result is still a disk. If the region
/// is a disk, returns the region without loose vertices. If it has no triangles, returns an empty
/// set. O(n log n), plus work linear in the mesh.
VertexSet largest_disk(const VertexSet& region, const Topology& topology,
                       std::span<const Eigen::Vector3d> positions);

}  // namespace lapwing
