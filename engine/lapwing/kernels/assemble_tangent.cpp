#include <Eigen/Core>

#include "lapwing/base/parallel.h"
#include "lapwing/kernels/cpu_kernels.h"
#include "lapwing/laplacian/ring_fit.h"

namespace lapwing {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

void assemble_row(const EnergyProblem& problem, Index i, double* out) {
  const auto& [v, rings, weights, rows] = problem.rings;
  const auto ring = rings[i];
  const double om = problem.row_weights[i];
  const double* w = weights.data() + rings.starts[i];
  const double* k = problem.stiffness.data() + rings.starts[i];
  Vector3d delta = Vector3d::Zero();
  for (std::size_t n = 0; n < ring.size(); ++n) delta += w[n] * (v[i] - v[ring[n]]);
  Matrix3d C = om * delta * delta.transpose();
  for (std::size_t n = 0; n < ring.size(); ++n) {
    const Vector3d e = v[i] - v[ring[n]];
    C += k[n] * e * e.transpose();
  }
  const Matrix3d inverse_F = inverse_cholesky_factor(C.trace() * Matrix3d::Identity() - C);
  Vector3d sum = Vector3d::Zero();  // sum of the arms, for the block of i itself
  for (std::size_t n = 0; n < ring.size(); ++n) {
    const Vector3d arm = k[n] * (v[i] - v[ring[n]]) + om * w[n] * delta;
    Eigen::Map<Matrix3d>(out + 9 * (n + 1)).noalias() = -inverse_F * cross_matrix(arm);
    sum += arm;
  }
  Eigen::Map<Matrix3d>(out).noalias() = inverse_F * cross_matrix(sum);
}

}  // namespace

void CpuKernels::assemble_tangent(const EnergyProblem& problem, std::span<double> blocks) {
  const auto starts = rsi_block_starts(problem.rings);
  constexpr std::size_t kRowsPerTask = 512;
  parallel_for(problem.rings.rows.size(), kRowsPerTask, [&](std::size_t begin, std::size_t end) {
    for (std::size_t r = begin; r < end; ++r) {
      assemble_row(problem, problem.rings.rows[r], blocks.data() + 9 * starts[r]);
    }
  });
}

}  // namespace lapwing
