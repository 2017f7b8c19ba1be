#pragma once

#include <span>
#include <vector>

#include "lapwing/mesh/topology.h"
#include "lapwing/solve/block_matrix.h"

namespace lapwing {

/// The sparse rows of M (3 x 3 blocks) or of L (1 x 1 blocks). Each row belongs to a vertex, and
/// contains blocks for that vertex and its ring.
struct BlockRows {
  int block_size = 3;
  std::vector<std::size_t> starts{0};  ///< in blocks
  std::vector<Index> columns;          ///< for each block, a vertex of the whole mesh
  Numbers values;                      ///< the numbers of each block in column-major order

  std::size_t size() const { return starts.size() - 1; }
};

/// Returns the pattern of M and of L for `rows`, without values: each vertex, then its ring.
BlockRows ring_blocks(const Adjacency& rings, std::span<const Index> rows);

/// Returns the rows of M for `rows`. Their values are undefined (see Kernels::assemble_rsi).
BlockRows rsi_rows(const Adjacency& rings, std::span<const Index> rows);

/// Returns the rows of L for `rows`: 1 for the vertex itself, and -w_ij for its ring. The
/// block of a vertex without a ring is zero. `weights` is the result of laplacian_weights.
BlockRows laplacian_rows(const Adjacency& rings, std::span<const double> weights,
                         std::span<const Index> rows);

/// The unknowns of a system and their vertices.
struct Unknowns {
  std::vector<Index> vertices;   ///< vertex of each unknown, ascending
  std::vector<Index> of_vertex;  ///< unknown of each vertex, or kNoIndex

  Unknowns() = default;
  Unknowns(std::vector<Index> list, std::size_t vertex_count);
  std::size_t size() const { return vertices.size(); }
};

/// The blocks of M (or L) in the column of each unknown, and the pattern of M'M over the unknowns.
/// Depends only on the region, not on positions or weights.
class NormalPattern {
 public:
  /// Uses only the pattern of `M`, not its values.
  NormalPattern(const BlockRows& M, const Unknowns& unknowns);

  const BlockPattern& blocks() const { return blocks_; }

  /// Returns N = M'M + diag(W). W has one number per unknown; if it is empty, W is 0. Each block is
  /// summed by one thread in a fixed order, over the rows that both unknowns share. `memory` is the
  /// memory of a matrix that is no longer needed, and is reused.
  BlockMatrix normal_matrix(const BlockRows& M, std::span<const double> W = {},
                            Numbers memory = {}) const;

  /// Returns A x I - G'G, the matrix after eliminating the rotations of the rows G (ENERGY.md
  /// section 5). A is a scalar matrix over the same unknowns. G has 3 x 3 blocks in the layout of
  /// M. `memory` is reused, as in `normal_matrix`.
  BlockMatrix reduced_matrix(const BlockMatrix& A, const BlockRows& G, Numbers memory = {}) const;

  /// Computes y = M' r over the unknowns: 3 numbers of r per row, 3 of y per unknown. A 1 x 1 block
  /// multiplies x, y and z.
  void multiply_transposed(const BlockRows& M, std::span<const double> r,
                           std::span<double> y) const;

 private:
  struct Entry {
    Index row;
    std::size_t block;
  };
  std::span<const Entry> entries(std::size_t unknown) const {
    return std::span(entries_).subspan(entry_starts_[unknown],
                                       entry_starts_[unknown + 1] - entry_starts_[unknown]);
  }
  void find_entries(const BlockRows& M, const Unknowns& unknowns);
  void find_blocks(const BlockRows& M);
  // Adds kSign M'M to the columns of N, which `begin_column` initializes.
  template <int kSign, typename Begin>
  void add_products(const BlockRows& M, BlockMatrix& N, const Begin& begin_column) const;

  std::vector<Index> unknown_of_block_;  ///< unknown of each block of M, or kNoIndex
  std::vector<std::size_t> entry_starts_;
  std::vector<Entry> entries_;
  BlockPattern blocks_;
};

/// Computes r = M u, or r = L u for x, y and z. `displacement` has one vector per vertex of the
/// whole mesh, and r has 3 numbers per row.
void multiply(const BlockRows& M, std::span<const Eigen::Vector3d> displacement,
              std::span<double> r);

}  // namespace lapwing
