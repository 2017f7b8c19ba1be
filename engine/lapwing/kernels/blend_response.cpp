#include "lapwing/base/parallel.h"
#include "lapwing/kernels/cpu_kernels.h"

namespace lapwing {

void blend_response(std::span<const Eigen::Vector3d> rest, std::span<const Index> moving,
                    std::span<const double> basis, std::span<const double> parameters,
                    std::span<Eigen::Vector3d> current) {
  constexpr std::size_t kVerticesPerTask = 4096;
  const std::size_t column = 3 * moving.size();
  parallel_for(moving.size(), kVerticesPerTask, [&](std::size_t begin, std::size_t end) {
    for (std::size_t m = begin; m < end; ++m) {
      Eigen::Vector3d displacement = Eigen::Vector3d::Zero();
      for (std::size_t k = 0; k < parameters.size(); ++k) {
        if (parameters[k] == 0.0) continue;
        const double* b = basis.data() + k * column + 3 * m;
        displacement += parameters[k] * Eigen::Vector3d(b[0], b[1], b[2]);
      }
      current[moving[m]] = rest[moving[m]] + displacement;
    }
  });
}

}  // namespace lapwing
