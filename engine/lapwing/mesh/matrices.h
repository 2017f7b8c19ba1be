#pragma once

#include <Eigen/Core>

#include "lapwing/mesh/mesh.h"

namespace lapwing {

/// The mesh of n vertices and m triangles with positions `V` (n x 3) and vertex numbers `F` (m x
/// 3), as libigl has them. Throws InputError, naming the row, for a number that is no vertex.
Mesh mesh_of(const Eigen::Ref<const Eigen::MatrixX3d>& V,
             const Eigen::Ref<const Eigen::MatrixX3i>& F);

/// The positions of a mesh, n x 3.
Eigen::MatrixX3d vertex_matrix(const Mesh& mesh);

/// The vertex numbers of the triangles of a mesh, m x 3. Polygons of more than three corners are
/// cut into triangles.
Eigen::MatrixX3i triangle_matrix(const Mesh& mesh);

}  // namespace lapwing
