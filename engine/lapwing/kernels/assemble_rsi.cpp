#include <Eigen/Core>
#include <Eigen/Geometry>

#include "lapwing/base/parallel.h"
#include "lapwing/kernels/cpu_kernels.h"
#include "lapwing/laplacian/ring_fit.h"

namespace lapwing {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

void assemble_row(const RingProblem& problem, Index i, double* out) {
  const auto ring = problem.rings[i];
  if (ring.empty()) {
    Eigen::Map<Matrix3d>(out).setZero();
    return;
  }
  const double* weights = problem.weights.data() + problem.rings.starts[i];
  const auto& v = problem.positions;
  const RingFit fit = fit_ring(i, ring, v);
  Vector3d delta = Vector3d::Zero();
  for (std::size_t k = 0; k < ring.size(); ++k) delta += weights[k] * (v[i] - v[ring[k]]);

  const Vector3d scaled_delta = delta * fit.inverse_S;
  const Matrix3d rotation = cross_matrix(delta) * fit.inverse_J;
  const auto block = [&](const Vector3d& x, double laplacian_entry, double* where) {
    Eigen::Map<Matrix3d> B(where);
    B.noalias() = scaled_delta * x.transpose();
    B.noalias() -= rotation * cross_matrix(x);
    B.diagonal().array() -= laplacian_entry;
  };
  block(-fit.center, 1.0, out);
  for (std::size_t k = 0; k < ring.size(); ++k) {
    block(v[ring[k]] - v[i] - fit.center, -weights[k], out + 9 * (k + 1));
  }
}

}  // namespace

std::vector<std::size_t> rsi_block_starts(const RingProblem& problem) {
  std::vector<std::size_t> starts(problem.rows.size() + 1, 0);
  for (std::size_t r = 0; r < problem.rows.size(); ++r) {
    starts[r + 1] = starts[r] + 1 + problem.rings.size(problem.rows[r]);
  }
  return starts;
}

BlockRows assemble_rsi_rows(Kernels& kernels, const RingProblem& problem) {
  BlockRows M = rsi_rows(problem.rings, problem.rows);
  kernels.assemble_rsi(problem, M.values);
  return M;
}

void CpuKernels::assemble_rsi(const RingProblem& problem, std::span<double> blocks) {
  const auto starts = rsi_block_starts(problem);
  constexpr std::size_t kRowsPerTask = 512;
  parallel_for(problem.rows.size(), kRowsPerTask, [&](std::size_t begin, std::size_t end) {
    for (std::size_t r = begin; r < end; ++r) {
      assemble_row(problem, problem.rows[r], blocks.data() + 9 * starts[r]);
    }
  });
}

}  // namespace lapwing
