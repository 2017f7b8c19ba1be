#include <algorithm>
#include <array>

#include "lapwing/base/parallel.h"
#include "lapwing/kernels/cpu_kernels.h"

namespace lapwing {
namespace {

// The displacements of this number of vertices remain in the L1 cache while all columns are added.
constexpr std::size_t kVerticesPerBatch = 256;

using Displacements = std::array<double, 3 * kVerticesPerBatch>;

// Adds `parameter` times column k to the displacements of `count` vertices, starting with
// moving[first].
void add_column(const ResponseColumns& columns, std::size_t k, double parameter, std::size_t first,
                std::size_t count, Displacements& displacement) {
  const std::size_t moving = columns.moving.size();
  if (columns.along_axes) {
    const double* const b = columns.numbers.data() + (4 * (k / 12) + k % 4) * moving + first;
    double* const out = displacement.data() + k / 4 % 3;
    for (std::size_t m = 0; m < count; ++m) out[3 * m] += parameter * b[m];
  } else {
    const double* const b = columns.numbers.data() + 3 * (k * moving + first);
    for (std::size_t i = 0; i < 3 * count; ++i) displacement[i] += parameter * b[i];
  }
}

}  // namespace

void blend_response(std::span<const Eigen::Vector3d> rest, const ResponseColumns& columns,
                    std::span<const double> parameters, std::span<Eigen::Vector3d> current) {
  const auto blend_batch = [&](std::size_t first, std::size_t count) {
    Displacements displacement;
    std::fill_n(displacement.begin(), 3 * count, 0.0);
    for (std::size_t k = 0; k < parameters.size(); ++k) {
      if (parameters[k] != 0.0) add_column(columns, k, parameters[k], first, count, displacement);
    }
    for (std::size_t m = 0; m < count; ++m) {
      const Index v = columns.moving[first + m];
      current[v] = rest[v] + Eigen::Map<const Eigen::Vector3d>(displacement.data() + 3 * m);
    }
  };
  constexpr std::size_t kVerticesPerTask = 4096;
  parallel_for(columns.moving.size(), kVerticesPerTask, [&](std::size_t begin, std::size_t end) {
    for (std::size_t first = begin; first < end; first += kVerticesPerBatch) {
      blend_batch(first, std::min(kVerticesPerBatch, end - first));
    }
  });
}

}  // namespace lapwing
