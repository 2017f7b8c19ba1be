#include <algorithm>
#include <array>

#include "lapwing/base/parallel.h"
#include "lapwing/kernels/cpu_kernels.h"

namespace lapwing {
namespace {

// So many displacements stay in the first cache while the columns pass by.
constexpr std::size_t kVerticesPerBatch = 256;

}  // namespace

void blend_response(std::span<const Eigen::Vector3d> rest, std::span<const Index> moving,
                    std::span<const double> basis, std::span<const double> parameters,
                    std::span<Eigen::Vector3d> current) {
  const std::size_t column = 3 * moving.size();
  const auto blend_batch = [&](std::size_t first, std::size_t count) {
    std::array<double, 3 * kVerticesPerBatch> displacement;
    std::fill_n(displacement.begin(), 3 * count, 0.0);
    for (std::size_t k = 0; k < parameters.size(); ++k) {
      const double parameter = parameters[k];
      if (parameter == 0.0) continue;
      const double* const b = basis.data() + k * column + 3 * first;
      for (std::size_t i = 0; i < 3 * count; ++i) displacement[i] += parameter * b[i];
    }
    for (std::size_t m = 0; m < count; ++m) {
      const Index v = moving[first + m];
      current[v] = rest[v] + Eigen::Map<const Eigen::Vector3d>(displacement.data() + 3 * m);
    }
  };
  constexpr std::size_t kVerticesPerTask = 4096;
  parallel_for(moving.size(), kVerticesPerTask, [&](std::size_t begin, std::size_t end) {
    for (std::size_t first = begin; first < end; first += kVerticesPerBatch) {
      blend_batch(first, std::min(kVerticesPerBatch, end - first));
    }
  });
}

}  // namespace lapwing
