#pragma once

#include <algorithm>

#include "lapwing/mesh/mesh.h"
#include "lapwing/mesh/topology.h"

namespace lapwing::test {

/// Returns the surface of `head` above `height`, moved by `away` in the direction away from the
/// point `inside`, which lies inside the head.
inline Mesh cap_of(const Mesh& head, double height, double away, const Eigen::Vector3d& inside) {
  using Eigen::Vector3d;
  std::vector<Vector3d> normals(head.vertex_count(), Vector3d::Zero());
  for (const auto& [a, b, c] : head.topology().triangles) {
    const auto& p = head.positions;
    const Vector3d normal = (p[b] - p[a]).cross(p[c] - p[a]);
    for (const Index v : {a, b, c}) normals[v] += normal;
  }
  Mesh cap;
  std::vector<Index> number(head.vertex_count(), kNoIndex);
  for (std::size_t f = 0; f < head.face_count(); ++f) {
    std::vector<Index> face(head.face(f).begin(), head.face(f).end());
    if (std::any_of(face.begin(), face.end(),
                    [&](Index v) { return head.positions[v].y() < height; })) {
      continue;
    }
    for (Index& v : face) {
      if (number[v] == kNoIndex) {
        number[v] = static_cast<Index>(cap.vertex_count());
        const Vector3d p = head.positions[v];
        const Vector3d out = normals[v].normalized();
        cap.positions.push_back(p + (out.dot(p - inside) < 0.0 ? -away : away) * out);
      }
      v = number[v];
    }
    cap.add_face(face);
  }
  return cap;
}

}  // namespace lapwing::test
