#include "solvers/scalar_lower.h"

#include <algorithm>
#include <limits>
#include <string>

#include "lapwing/base/errors.h"

namespace lapwing::bench {
namespace {

// Calls visit(column, row, entry of the block matrix's values) for every scalar of the lower
// triangle, column after column.
template <typename Visit>
void for_each_scalar(const BlockPattern& pattern, std::size_t b, Visit visit) {
  for (std::size_t c = 0; c < pattern.size(); ++c) {
    for (std::size_t q = 0; q < b; ++q) {
      for (std::size_t e = pattern.starts[c]; e < pattern.starts[c + 1]; ++e) {
        const std::size_t r = pattern.rows[e];
        for (std::size_t p = r == c ? q : 0; p < b; ++p) {
          visit(c * b + q, r * b + p, e * b * b + q * b + p);
        }
      }
    }
  }
}

}  // namespace

ScalarLower scalar_lower_pattern(const BlockPattern& pattern, int block_size) {
  const auto b = static_cast<std::size_t>(block_size);
  const std::size_t n = pattern.size() * b;
  const std::size_t entries = pattern.rows.size() * b * b - pattern.size() * (b * (b - 1) / 2);
  if (entries >= static_cast<std::size_t>(std::numeric_limits<int>::max())) {
    throw SolverError("the system has " + std::to_string(entries) +
                      " entries, more than this solver can index; choose a smaller region");
  }
  ScalarLower lower(static_cast<Eigen::Index>(n), static_cast<Eigen::Index>(n));
  lower.resizeNonZeros(static_cast<Eigen::Index>(entries));
  int* starts = lower.outerIndexPtr();
  int* rows = lower.innerIndexPtr();
  int next = 0;
  std::size_t column = 0;
  starts[0] = 0;
  for_each_scalar(pattern, b, [&](std::size_t c, std::size_t r, std::size_t) {
    while (column < c) starts[++column] = next;
    rows[next++] = static_cast<int>(r);
  });
  while (column < n) starts[++column] = next;
  std::fill(lower.valuePtr(), lower.valuePtr() + entries, 0.0);
  return lower;
}

void fill_scalar_lower(const BlockMatrix& matrix, ScalarLower& lower) {
  double* values = lower.valuePtr();
  const double* blocks = matrix.values.data();
  for_each_scalar(*matrix.pattern, static_cast<std::size_t>(matrix.block_size),
                  [&](std::size_t, std::size_t, std::size_t entry) { *values++ = blocks[entry]; });
}

}  // namespace lapwing::bench
