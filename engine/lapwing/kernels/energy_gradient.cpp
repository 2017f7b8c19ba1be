#include "lapwing/base/parallel.h"
#include "lapwing/kernels/cpu_ring_rotations.h"

namespace lapwing {

using Eigen::Vector3d;

void CpuRingRotations::energy_gradient(std::span<double> g) {
  constexpr std::size_t kRowsPerTask = 1024;
  const std::size_t n = rings_.unknown_rows.size();
  parallel_for(n, kRowsPerTask, [&](std::size_t begin, std::size_t end) {
    for (std::size_t k = begin; k < end; ++k) {
      const std::size_t row = rings_.unknown_rows[k];
      Vector4 sum = residuals_[row];
      for (std::size_t e = rings_.starts[row]; e < rings_.starts[row + 1]; ++e) {
        sum -= rings_.reverse_weights[e] * residuals_[rings_.neighbours[e]];
      }
      if (!rings_.stiffness.empty()) sum.head<3>() += edge_forces(row);
      for (std::size_t axis = 0; axis < 3; ++axis) {
        g[axis * n + k] = sum[static_cast<Eigen::Index>(axis)];
      }
    }
  });
}

// Edges go from the row to its neighbours, against the sense of the contract: both signs cancel.
Vector3d CpuRingRotations::edge_forces(std::size_t row) const {
  const Vector3d here = displacement_[row].head<3>();
  Vector3d own_edges = Vector3d::Zero();  // sum of k (v_j - v_i), whose turn T_i - I is taken once
  Vector3d sum = Vector3d::Zero();
  for (std::size_t e = rings_.starts[row]; e < rings_.starts[row + 1]; ++e) {
    const Index j = rings_.neighbours[e];
    const double k = rings_.stiffness[e];
    const Vector3d shift = displacement_[j].head<3>() - here;
    own_edges += k * rings_.edges[e];
    Vector3d off = shift;
    if (rings_.is_row(j)) off += shift - (transforms_[j] * rings_.edges[e] - rings_.edges[e]);
    sum -= k * off;
  }
  return sum + (transforms_[row] * own_edges - own_edges);
}

}  // namespace lapwing
