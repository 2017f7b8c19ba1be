#include "lapwing/base/parallel.h"
#include "lapwing/kernels/cpu_kernels.h"

namespace lapwing {

void CpuKernels::sample_laplacians(const RingProblem& problem,
                                   std::span<Eigen::Vector3d> laplacians) {
  constexpr std::size_t kRowsPerTask = 4096;
  parallel_for(problem.rows.size(), kRowsPerTask, [&](std::size_t begin, std::size_t end) {
    for (std::size_t r = begin; r < end; ++r) {
      const Index i = problem.rows[r];
      const auto ring = problem.rings[i];
      const double* weights = problem.weights.data() + problem.rings.starts[i];
      Eigen::Vector3d delta = Eigen::Vector3d::Zero();
      for (std::size_t k = 0; k < ring.size(); ++k) {
        delta += weights[k] * (problem.positions[i] - problem.positions[ring[k]]);
      }
      laplacians[r] = delta;
    }
  });
}

}  // namespace lapwing
