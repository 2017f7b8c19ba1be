#include "lapwing/io/gltf_tangents.h"

#include <Eigen/Geometry>
#include <Eigen/LU>

namespace lapwing {

using Eigen::Vector3d;

std::vector<Vector3d> transport_tangents(const GltfLayout& layout, const GltfRecords& set,
                                         const Mesh& mesh, std::span<const Vector3d> rest,
                                         std::span<const Vector3d> normals) {
  const Eigen::Matrix3d to_world = layout.objects[set.object].to_world.linear();
  std::vector<Vector3d> old;
  for (std::size_t k = 0; k < set.count(); ++k) old.push_back(to_world * set.tangents->vector3(k));
  std::vector<Vector3d> sums(set.count(), Vector3d::Zero());
  const std::vector<Index>& corners = mesh.face_vertices();
  for (std::size_t c = 0; c < corners.size(); ++c) {
    const std::size_t record = layout.record_of_corner[c];
    if (record < set.first_record || record - set.first_record >= set.count()) continue;
    const std::size_t first = c - c % 3;  // faces are triangles
    const Vector3d e = rest[corners[first + 1]] - rest[corners[first]];
    const Vector3d f = rest[corners[first + 2]] - rest[corners[first]];
    const double area = e.cross(f).norm();
    if (!(area > 0.0)) continue;
    // The old tangent as a e + b f, in the triangle's plane.
    const Vector3d t = old[record - set.first_record];
    const Eigen::Matrix2d products{{e.dot(e), e.dot(f)}, {e.dot(f), f.dot(f)}};
    const Eigen::Vector2d ab = products.inverse() * Eigen::Vector2d(e.dot(t), f.dot(t));
    if (!ab.allFinite()) continue;
    const Vector3d& corner = mesh.positions[corners[first]];
    const Vector3d now = ab[0] * (mesh.positions[corners[first + 1]] - corner) +
                         ab[1] * (mesh.positions[corners[first + 2]] - corner);
    sums[record - set.first_record] += area * now.stableNormalized();
  }
  for (std::size_t k = 0; k < set.count(); ++k) {
    const Index normal = layout.normal_of_record[set.first_record + k];
    if (normal != kNoIndex) sums[k] -= normals[normal].dot(sums[k]) * normals[normal];
    const Vector3d tangent = sums[k].stableNormalized();
    if (tangent.allFinite() && tangent.squaredNorm() > 0.5) old[k] = tangent;
  }
  return old;
}

}  // namespace lapwing
