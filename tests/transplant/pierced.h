#pragma once

#include <algorithm>

#include "lapwing/mesh/mesh.h"

namespace lapwing::test {

/// The mesh without the faces with a corner less than `radius` from a point.
inline Mesh with_hole(const Mesh& mesh, const Eigen::Vector3d& center, double radius) {
  Mesh result;
  result.positions = mesh.positions;
  for (std::size_t f = 0; f < mesh.face_count(); ++f) {
    const auto face = mesh.face(f);
    if (std::all_of(face.begin(), face.end(),
                    [&](Index v) { return (mesh.positions[v] - center).norm() >= radius; })) {
      result.add_face(face);
    }
  }
  return result;
}

}  // namespace lapwing::test
