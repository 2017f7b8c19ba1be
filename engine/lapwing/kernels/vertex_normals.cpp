#include <Eigen/Geometry>

#include "lapwing/base/parallel.h"
#include "lapwing/kernels/cpu_kernels.h"

namespace lapwing {

using Eigen::Vector3d;

void vertex_normals(std::span<const Vector3d> positions, std::span<const Triangle> triangles,
                    const Adjacency& vertex_triangles, std::span<const Index> which,
                    std::span<Vector3d> normals) {
  constexpr std::size_t kVerticesPerTask = 2048;
  parallel_for(which.size(), kVerticesPerTask, [&](std::size_t begin, std::size_t end) {
    for (std::size_t m = begin; m < end; ++m) {
      Vector3d sum = Vector3d::Zero();
      for (const Index t : vertex_triangles[which[m]]) {
        const Triangle& corners = triangles[t];
        const Vector3d& a = positions[corners[0]];
        sum += (positions[corners[1]] - a).cross(positions[corners[2]] - a);
      }
      const double length = sum.norm();
      normals[which[m]] = length > 0.0 ? Vector3d(sum / length) : Vector3d::Zero();
    }
  });
}

}  // namespace lapwing
