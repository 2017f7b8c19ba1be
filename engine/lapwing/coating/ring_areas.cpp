#include "lapwing/coating/ring_areas.h"

#include <algorithm>

#include <Eigen/Geometry>

#include "lapwing/base/parallel.h"

namespace lapwing {

std::vector<double> squared_rings(const Adjacency& rings, std::span<const double> weights,
                                  std::span<const Eigen::Vector3d> positions,
                                  std::span<const Index> rows) {
  constexpr std::size_t kRowsPerTask = 2048;
  std::vector<double> squares(rows.size(), 0.0);
  parallel_for(rows.size(), kRowsPerTask, [&](std::size_t begin, std::size_t end) {
    for (std::size_t r = begin; r < end; ++r) {
      const Index i = rows[r];
      for (std::size_t e = rings.starts[i]; e < rings.starts[i + 1]; ++e) {
        squares[r] += weights[e] * (positions[rings.values[e]] - positions[i]).squaredNorm();
      }
    }
  });
  double sum = 0.0;
  for (const double square : squares) sum += square;
  if (rows.empty() || sum <= 0.0) return std::vector<double>(rows.size(), 1.0);
  const double least = kSmallestRingShare * sum / static_cast<double>(rows.size());
  for (double& square : squares) square = std::max(square, least);
  return squares;
}

double surface_area(std::span<const Triangle> triangles,
                    std::span<const Eigen::Vector3d> positions) {
  double twice = 0.0;
  for (const auto& [a, b, c] : triangles) {
    twice += (positions[b] - positions[a]).cross(positions[c] - positions[a]).norm();
  }
  return 0.5 * twice;
}

}  // namespace lapwing
