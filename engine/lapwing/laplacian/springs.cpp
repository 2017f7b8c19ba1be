#include "lapwing/laplacian/springs.h"

#include <algorithm>
#include <cmath>

namespace lapwing {
namespace {

using Eigen::Vector3d;

constexpr double kStiffness = 1e7;

// Returns the index of block (row, column) among the blocks of a matrix. Requires row >= column.
std::size_t block_at(const BlockPattern& pattern, Index row, Index column) {
  const auto rows = pattern.column(column);
  return pattern.starts[column] +
         static_cast<std::size_t>(std::lower_bound(rows.begin(), rows.end(), row) - rows.begin());
}

}  // namespace

std::vector<Spring> with_finite_stiffness(std::span<const Spring> springs, const BlockMatrix& A) {
  std::vector<Spring> finite(springs.begin(), springs.end());
  double sum = 0.0;
  for (std::size_t u = 0; u < A.pattern->size(); ++u) sum += A.block(A.pattern->starts[u])[0];
  const double stiff =
      kStiffness * sum / static_cast<double>(std::max<std::size_t>(1, A.pattern->size()));
  for (Spring& spring : finite) {
    if (spring.stiffness == kStiff) spring.stiffness = stiff;
  }
  return finite;
}

void add_springs(std::span<const Spring> springs, const Unknowns& unknowns, BlockMatrix& A) {
  const auto b = static_cast<std::size_t>(A.block_size);
  for (const Spring& spring : springs) {
    for (std::size_t k = 0; k < 3; ++k) {
      const Index row = unknowns.of_vertex[spring.corners[k]];
      if (row == kNoIndex || spring.shares[k] == 0.0) continue;
      for (std::size_t l = 0; l < 3; ++l) {
        const Index column = unknowns.of_vertex[spring.corners[l]];
        if (column == kNoIndex || column > row || spring.shares[l] == 0.0) continue;
        double* block = A.values.data() + b * b * block_at(*A.pattern, row, column);
        const double value = spring.stiffness * spring.shares[k] * spring.shares[l];
        for (std::size_t axis = 0; axis < b; ++axis) block[(b + 1) * axis] += value;
      }
    }
  }
}

void add_spring_product(std::span<const Spring> springs, const Unknowns& unknowns,
                        std::span<const Vector3d> u, std::span<double> y) {
  for (const Spring& spring : springs) {
    Vector3d at = Vector3d::Zero();
    for (std::size_t k = 0; k < 3; ++k) at += spring.shares[k] * u[spring.corners[k]];
    for (std::size_t k = 0; k < 3; ++k) {
      const Index row = unknowns.of_vertex[spring.corners[k]];
      if (row == kNoIndex || spring.shares[k] == 0.0) continue;
      Eigen::Map<Vector3d>(y.data() + 3 * row) += spring.stiffness * spring.shares[k] * at;
    }
  }
}

Numbers spring_forces(std::span<const Spring> springs, const Unknowns& unknowns) {
  if (springs.empty()) return {};
  Numbers forces(3 * unknowns.size());
  std::fill(forces.begin(), forces.end(), 0.0);
  for (const Spring& spring : springs) {
    for (std::size_t k = 0; k < 3; ++k) {
      const Index row = unknowns.of_vertex[spring.corners[k]];
      if (row == kNoIndex) continue;
      Eigen::Map<Vector3d>(forces.data() + 3 * row) +=
          spring.stiffness * spring.shares[k] * spring.prescribed;
    }
  }
  return forces;
}

}  // namespace lapwing
