#include <Eigen/Geometry>

#include "lapwing/base/parallel.h"
#include "lapwing/kernels/cpu_kernels.h"

namespace lapwing {

void vertex_normals(std::span<const Eigen::Vector3d> positions, std::span<const Triangle> triangles,
                    const Adjacency& vertex_triangles, std::span<const Index> which,
                    std::span<Eigen::Vector3d> normals) {
  constexpr std::size_t kVerticesPerTask = 2048;
  parallel_for(which.size(), kVerticesPerTask, [&](std::size_t begin, std::size_t end) {
    for (std::size_t m = begin; m < end; ++m) {
      const Index i = which[m];
      Eigen::Vector3d sum = Eigen::Vector3d::Zero();
      for (const Index t : vertex_triangles[i]) {
        const Eigen::Vector3d& a = positions[triangles[t][0]];
        sum += (positions[triangles[t][1]] - a).cross(positions[triangles[t][2]] - a);
      }
      const double length = sum.norm();
      normals[i] = length > 0.0 ? Eigen::Vector3d(sum / length) : Eigen::Vector3d::Zero();
    }
  });
}

}  // namespace lapwing
