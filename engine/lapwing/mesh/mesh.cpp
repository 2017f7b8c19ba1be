#include "lapwing/mesh/mesh.h"

#include "lapwing/base/errors.h"

namespace lapwing {

Bounds bounds_of(std::span<const Eigen::Vector3d> positions) {
  Bounds bounds;
  bool first = true;
  for (const Eigen::Vector3d& p : positions) {
    if (!p.allFinite()) continue;
    bounds.min = first ? p : Eigen::Vector3d(bounds.min.cwiseMin(p));
    bounds.max = first ? p : Eigen::Vector3d(bounds.max.cwiseMax(p));
    first = false;
  }
  return bounds;
}

Bounds united(const Bounds& a, const Bounds& b) {
  return {a.min.cwiseMin(b.min), a.max.cwiseMax(b.max)};
}

void validate_indices(const Mesh& mesh) {
  for (std::size_t f = 0; f < mesh.face_count(); ++f) {
    for (const Index v : mesh.face(f)) {
      if (v >= mesh.vertex_count()) {
        throw InputError("face " + std::to_string(f) + " names vertex " + std::to_string(v) +
                         ", but the mesh has " + std::to_string(mesh.vertex_count()) +
                         " vertices (numbered from 0); remove the face or add the vertex");
      }
    }
  }
}

}  // namespace lapwing
