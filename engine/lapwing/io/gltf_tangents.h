#pragma once

#include <span>
#include <vector>

#include <Eigen/Core>

#include "lapwing/io/gltf_layout.h"
#include "lapwing/mesh/mesh.h"

namespace lapwing {

/// Returns the tangents of a set of records in world coordinates, after the vertices of `mesh`
/// moved from `rest`. Each triangle at a record carries the old tangent along like a line drawn on
/// it. The area-weighted mean is made perpendicular to the new normal (`normals`, per entry of
/// MeshAttributes::normals) and normalized. A tangent stays if no triangle defines it.
std::vector<Eigen::Vector3d> transport_tangents(const GltfLayout& layout, const GltfRecords& set,
                                                const Mesh& mesh,
                                                std::span<const Eigen::Vector3d> rest,
                                                std::span<const Eigen::Vector3d> normals);

}  // namespace lapwing
