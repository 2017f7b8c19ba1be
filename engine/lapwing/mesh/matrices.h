#pragma once

#include <Eigen/Core>

#include "lapwing/mesh/mesh.h"
#include "lapwing/mesh/topology.h"

namespace lapwing {

/// The mesh of n vertices and m triangles with positions `V` (n x 3) and vertex numbers `F` (m x
/// 3), as libigl has them. Throws InputError, naming the row, for a number that is no vertex.
Mesh mesh_of(const Eigen::Ref<const Eigen::MatrixX3d>& V,
             const Eigen::Ref<const Eigen::MatrixX3i>& F);

// How Eigen allocates a matrix depends on the compiler's flags. The next two are inline, so that
// the program that frees a matrix is also the one that allocated it.

/// The positions of a mesh, n x 3.
inline Eigen::MatrixX3d vertex_matrix(const Mesh& mesh) {
  Eigen::MatrixX3d V(static_cast<Eigen::Index>(mesh.vertex_count()), 3);
  for (Eigen::Index v = 0; v < V.rows(); ++v) {
    V.row(v) = mesh.positions[static_cast<std::size_t>(v)].transpose();
  }
  return V;
}

/// The vertex numbers of the triangles of a mesh, m x 3. Polygons of more than three corners are
/// cut into triangles.
inline Eigen::MatrixX3i triangle_matrix(const Mesh& mesh) {
  const std::vector<Triangle>& triangles = mesh.topology().triangles;
  Eigen::MatrixX3i F(static_cast<Eigen::Index>(triangles.size()), 3);
  for (Eigen::Index t = 0; t < F.rows(); ++t) {
    const Triangle& corners = triangles[static_cast<std::size_t>(t)];
    for (Eigen::Index c = 0; c < 3; ++c) {
      F(t, c) = static_cast<int>(corners[static_cast<std::size_t>(c)]);
    }
  }
  return F;
}

}  // namespace lapwing
