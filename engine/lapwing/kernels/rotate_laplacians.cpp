#include "lapwing/base/parallel.h"
#include "lapwing/kernels/cpu_ring_rotations.h"

namespace lapwing {

using Eigen::Vector3d;

void CpuRingRotations::rotate_laplacians(std::span<double> b) {
  constexpr std::size_t kRowsPerTask = 1024;
  const std::size_t n = rings_.unknown_rows.size();
  parallel_for(n, kRowsPerTask, [&](std::size_t begin, std::size_t end) {
    for (std::size_t k = begin; k < end; ++k) {
      const std::size_t row = rings_.unknown_rows[k];
      Vector4 sum = turned_[row];
      for (std::size_t e = rings_.starts[row]; e < rings_.starts[row + 1]; ++e) {
        sum -= rings_.reverse_weights[e] * turned_[rings_.neighbours[e]];
      }
      if (!rings_.stiffness.empty()) sum.head<3>() += edge_forces(row);
      for (std::size_t axis = 0; axis < 3; ++axis) {
        b[axis * n + k] = sum[static_cast<Eigen::Index>(axis)];
      }
    }
  });
}

Vector3d CpuRingRotations::edge_forces(std::size_t row) const {
  const Eigen::Matrix3d T = transform(row);
  Vector3d sum = Vector3d::Zero();
  for (std::size_t e = rings_.starts[row]; e < rings_.starts[row + 1]; ++e) {
    const Index j = rings_.neighbours[e];
    const Vector3d was = -rings_.edges[e];
    Vector3d wish = T * was - was;
    if (rings_.is_row(j)) wish += transform(j) * was - was;
    sum += rings_.stiffness[e] * wish;
  }
  return sum;
}

}  // namespace lapwing
