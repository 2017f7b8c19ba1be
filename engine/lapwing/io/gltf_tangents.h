#pragma once

#include <span>
#include <vector>

#include <Eigen/Core>

#include "lapwing/io/gltf_layout.h"
#include "lapwing/mesh/mesh.h"

namespace lapwing {

/// The tangents of a set of records in the world's coordinates, after the vertices of `mesh` moved
/// from `rest`: the old one goes with each triangle at its record as a line drawn there would, and
/// the mean, by area, is laid at right angles to the new normal (`normals`: per entry of
/// MeshAttributes::normals). Of length 1; as it was where no triangle says anything.
std::vector<Eigen::Vector3d> carried_tangents(const GltfLayout& layout, const GltfRecords& set,
                                              const Mesh& mesh,
                                              std::span<const Eigen::Vector3d> rest,
                                              std::span<const Eigen::Vector3d> normals);

}  // namespace lapwing
