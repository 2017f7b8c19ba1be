#include "lapwing/solve/block_matrix.h"

#include <algorithm>
#include <array>
#include <limits>

#include "lapwing/base/cancellation.h"
#include "lapwing/base/errors.h"

namespace lapwing {
namespace {

// out += A in; B is the size of the blocks.
template <std::size_t B>
void add_product(const BlockMatrix& A, const double* in, double* out) {
  for (std::size_t c = 0; c < A.pattern->size(); ++c) {
    const double* in_c = in + c * B;
    std::array<double, B> out_c{};
    for (std::size_t e = A.pattern->starts[c]; e < A.pattern->starts[c + 1]; ++e) {
      const std::size_t r = A.pattern->rows[e];
      const double* block = A.values.data() + e * B * B;
      double* out_r = out + r * B;
      const double* in_r = in + r * B;
      for (std::size_t q = 0; q < B; ++q) {
        for (std::size_t p = 0; p < B; ++p) out_r[p] += block[q * B + p] * in_c[q];
      }
      if (r == c) continue;
      for (std::size_t q = 0; q < B; ++q) {
        for (std::size_t p = 0; p < B; ++p) out_c[q] += block[q * B + p] * in_r[p];
      }
    }
    for (std::size_t q = 0; q < B; ++q) out[c * B + q] += out_c[q];
  }
}

}  // namespace

void multiply(const BlockMatrix& A, std::span<const double> x, std::span<double> y,
              std::size_t columns) {
  const std::size_t n = A.scalar_size();
  std::fill(y.begin(), y.end(), 0.0);
  for (std::size_t k = 0; k < columns; ++k) {
    const double* in = x.data() + k * n;
    double* out = y.data() + k * n;
    if (A.block_size == 1) {
      add_product<1>(A, in, out);
    } else {
      add_product<3>(A, in, out);
    }
  }
}

BlockGraph block_graph(const BlockPattern& pattern) {
  const std::size_t n = pattern.size();
  if (2 * pattern.rows.size() >= static_cast<std::size_t>(std::numeric_limits<int>::max())) {
    throw SolverError("the system has " + std::to_string(pattern.rows.size()) +
                      " blocks, more than the ordering can index; choose a smaller region");
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
  // In this order, each vertex first receives its smaller neighbours, then its larger ones.
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
