#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "lapwing/base/numbers.h"
#include "lapwing/mesh/mesh.h"

namespace lapwing {

/// Pattern of a symmetric matrix of square blocks: the lower triangle in compressed columns. Column
/// c contains the block rows `rows[starts[c], starts[c+1])` in ascending order. The first is the
/// diagonal block, which is always present.
struct BlockPattern {
  std::vector<std::size_t> starts{0};
  std::vector<Index> rows;

  std::size_t size() const { return starts.size() - 1; }  ///< number of block columns
  std::span<const Index> column(std::size_t c) const {
    return std::span(rows).subspan(starts[c], starts[c + 1] - starts[c]);
  }
};

/// A symmetric matrix in blocks of `block_size` x `block_size` (1 or 3). The pattern must outlive
/// it. `values` contains the blocks in the pattern's order, each in column-major order. Diagonal
/// blocks are stored in full.
struct BlockMatrix {
  const BlockPattern* pattern = nullptr;
  int block_size = 3;
  Numbers values;

  std::size_t scalar_size() const { return pattern->size() * static_cast<std::size_t>(block_size); }
  std::span<const double> block(std::size_t entry) const {
    const auto b2 = static_cast<std::size_t>(block_size * block_size);
    return std::span(values).subspan(entry * b2, b2);
  }
};

/// Computes y = A x for `columns` vectors, which are stored one after the other. The order of
/// summation is fixed.
void multiply(const BlockMatrix& A, std::span<const double> x, std::span<double> y,
              std::size_t columns);

/// The adjacency graph of a pattern in compressed rows. Contains both triangles without the
/// diagonal; the neighbours in each row are ascending.
struct BlockGraph {
  std::vector<int> starts;
  std::vector<int> neighbours;
};
/// Throws SolverError if the graph has 2^31 edges or more, the limit of the ordering libraries.
BlockGraph block_graph(const BlockPattern& pattern);

}  // namespace lapwing
