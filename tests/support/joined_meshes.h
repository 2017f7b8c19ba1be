#pragma once

#include <vector>

#include "lapwing/mesh/mesh.h"

namespace lapwing::test {

/// Returns a mesh with the vertices and faces of `mesh`, followed by those of `other`.
inline Mesh joined(Mesh mesh, const Mesh& other) {
  const auto first = static_cast<Index>(mesh.vertex_count());
  mesh.positions.insert(mesh.positions.end(), other.positions.begin(), other.positions.end());
  for (std::size_t f = 0; f < other.face_count(); ++f) {
    std::vector<Index> face(other.face(f).begin(), other.face(f).end());
    for (Index& v : face) v += first;
    mesh.add_face(face);
  }
  return mesh;
}

}  // namespace lapwing::test
