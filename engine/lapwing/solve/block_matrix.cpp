#include "lapwing/solve/block_matrix.h"

#include <algorithm>
#include <limits>

#include "lapwing/base/cancellation.h"
#include "lapwing/base/errors.h"

namespace lapwing {

void multiply(const BlockMatrix& A, std::span<const double> x, std::span<double> y,
              std::size_t columns) {
  const auto b = static_cast<std::size_t>(A.block_size);
  const std::size_t n = A.scalar_size();
  std::fill(y.begin(), y.end(), 0.0);
  for (std::size_t k = 0; k < columns; ++k) {
    const double* in = x.data() + k * n;
    double* out = y.data() + k * n;
    for (std::size_t c = 0; c < A.pattern->size(); ++c) {
      for (std::size_t e = A.pattern->starts[c]; e < A.pattern->starts[c + 1]; ++e) {
        const std::size_t r = A.pattern->rows[e];
        const double* block = A.values.data() + e * b * b;
        for (std::size_t q = 0; q < b; ++q) {
          for (std::size_t p = 0; p < b; ++p) {
            out[r * b + p] += block[q * b + p] * in[c * b + q];
            if (r != c) out[c * b + q] += block[q * b + p] * in[r * b + p];
          }
        }
      }
    }
  }
}

BlockGraph block_graph(const BlockPattern& pattern) {
  const std::size_t n = pattern.size();
  if (2 * pattern.rows.size() >= static_cast<std::size_t>(std::numeric_limits<int>::max())) {
    throw SolverError("the system has " + std::to_string(pattern.rows.size()) +
                      " blocks, more than the ordering can number; choose a smaller region");
  }
  BlockGraph graph;
  CancelCheck check;
  graph.starts.assign(n + 1, 0);
  for (std::size_t c = 0; c < n; ++c) {
    check();
    for (const Index r : pattern.column(c)) {
      if (r == c) continue;
      ++graph.starts[c + 1];
      ++graph.starts[r + 1];
    }
  }
  for (std::size_t i = 0; i < n; ++i) graph.starts[i + 1] += graph.starts[i];
  graph.neighbours.resize(static_cast<std::size_t>(graph.starts[n]));
  std::vector<int> next(graph.starts.begin(), graph.starts.end() - 1);
  // Columns in order: each vertex first receives its smaller neighbours, then its larger ones.
  for (std::size_t c = 0; c < n; ++c) {
    check();
    for (const Index r : pattern.column(c)) {
      if (r != c) graph.neighbours[static_cast<std::size_t>(next[r]++)] = static_cast<int>(c);
    }
  }
  for (std::size_t c = 0; c < n; ++c) {
    check();
    for (const Index r : pattern.column(c)) {
      if (r != c) graph.neighbours[static_cast<std::size_t>(next[c]++)] = static_cast<int>(r);
    }
  }
  return graph;
}

}  // namespace lapwing
