#include "lapwing/coating/ring_operators.h"

#include <algorithm>

#include <Eigen/Geometry>

#include "lapwing/base/parallel.h"

namespace lapwing {

using Eigen::Vector3d;

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

std::vector<Vector3d> laplacians(const RegionRings& rings, const Columns& u, std::size_t n) {
  const auto at = [&](std::size_t own) {
    return own < n ? Vector3d(u[own], u[n + own], u[2 * n + own]) : Vector3d(0.0, 0.0, 0.0);
  };
  std::vector<Vector3d> result(rings.row_count());
  for (std::size_t r = 0; r < result.size(); ++r) {
    result[r] = rings.starts[r] == rings.starts[r + 1] ? Vector3d::Zero() : at(r);
    for (std::size_t e = rings.starts[r]; e < rings.starts[r + 1]; ++e) {
      result[r] -= rings.weights[e] * at(rings.neighbours[e]);
    }
  }
  return result;
}

Columns transposed(const RegionRings& rings, std::span<const Vector3d> y, std::size_t n) {
  Columns b(3 * n);
  for (std::size_t k = 0; k < n; ++k) {
    Vector3d sum = y[k];
    for (std::size_t e = rings.starts[k]; e < rings.starts[k + 1]; ++e) {
      const Index j = rings.neighbours[e];
      if (rings.is_row(j)) sum -= rings.reverse_weights[e] * y[j];
    }
    for (std::size_t axis = 0; axis < 3; ++axis) {
      b[axis * n + k] = sum[static_cast<Eigen::Index>(axis)];
    }
  }
  return b;
}

double norm(const Columns& x) {
  return Eigen::Map<const Eigen::VectorXd>(x.data(), static_cast<Eigen::Index>(x.size())).norm();
}

}  // namespace lapwing
