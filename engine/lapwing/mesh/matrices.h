#pragma once

#include <array>
#include <string>

#include <Eigen/Core>

#include "lapwing/base/errors.h"
#include "lapwing/mesh/mesh.h"
#include "lapwing/mesh/topology.h"

namespace lapwing {

// The alignment with which Eigen allocates matrices depends on the compiler flags. These functions
// are inline so that a matrix is allocated and freed with the same flags, those of the caller.

/// Returns the mesh with positions `V` (n x 3) and triangles `F` (m x 3), as in libigl. Throws
/// InputError, naming the row, if an entry of `F` is not a vertex.
inline Mesh mesh_of(const Eigen::Ref<const Eigen::MatrixX3d>& V,
                    const Eigen::Ref<const Eigen::MatrixX3i>& F) {
  Mesh mesh;
  mesh.positions.reserve(static_cast<std::size_t>(V.rows()));
  for (Eigen::Index v = 0; v < V.rows(); ++v) mesh.positions.emplace_back(V.row(v).transpose());
  Faces& faces = mesh.edit_faces();
  for (Eigen::Index f = 0; f < F.rows(); ++f) {
    std::array<Index, 3> corners{};
    for (Eigen::Index c = 0; c < 3; ++c) {
      const int vertex = F(f, c);
      if (vertex < 0 || vertex >= V.rows()) {
        throw InputError("F: row " + std::to_string(f) + " has vertex " + std::to_string(vertex) +
                         ", but V has " + std::to_string(V.rows()) +
                         " rows; vertices are numbered from 0");
      }
      corners[static_cast<std::size_t>(c)] = static_cast<Index>(vertex);
    }
    faces.add(corners);
  }
  return mesh;
}

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
