#pragma once

#include <Eigen/Core>

#include "lapwing/mesh/mesh.h"
#include "lapwing/mesh/topology.h"

namespace lapwing {

/// Returns the mesh with positions `V` (n x 3) and triangles `F` (m x 3), as in libigl. Throws
/// InputError, naming the row, if an entry of `F` is not a vertex.
Mesh mesh_of(const Eigen::Ref<const Eigen::MatrixX3d>& V,
             const Eigen::Ref<const Eigen::MatrixX3i>& F);

// How Eigen allocates a matrix depends on the compiler flags. The next two functions are inline, so
// that the same program allocates and frees the matrix.

/// Returns the positions of a mesh, n x 3.
inline Eigen::MatrixX3d vertex_matrix(const Mesh& mesh) {
  Eigen::MatrixX3d V(static_cast<Eigen::Index>(mesh.vertex_count()), 3);
  for (Eigen::Index v = 0; v < V.rows(); ++v) {
    V.row(v) = mesh.positions[static_cast<std::size_t>(v)].transpose();
  }
  return V;
}

/// Returns the vertex numbers of the triangles of a mesh, m x 3. Polygons of more than three
/// corners are triangulated.
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
