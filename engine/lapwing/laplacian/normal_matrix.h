#pragma once

#include <span>
#include <vector>

#include "lapwing/mesh/topology.h"
#include "lapwing/solve/block_matrix.h"

namespace lapwing {

/// The sparse rows of M (3 x 3 blocks) or of L (1 x 1): row r belongs to one vertex and holds
/// blocks for that vertex and its ring.
struct BlockRows {
  int block_size = 3;
  std::vector<std::size_t> starts{0};  ///< in blocks
  std::vector<Index> columns;          ///< per block: a vertex of the whole mesh
  Numbers values;                      ///< per block: its numbers, column after column

  std::size_t size() const { return starts.size() - 1; }
};

/// Returns the pattern of M and of L for `rows`, without values: each vertex, then its ring.
BlockRows ring_blocks(const Adjacency& rings, std::span<const Index> rows);

/// Returns the rows of M for `rows`. Their values are undefined (see Kernels::assemble_rsi).
BlockRows rsi_rows(const Adjacency& rings, std::span<const Index> rows);

/// Returns the rows of L for `rows`: 1 for the vertex itself, -w_ij for its ring. A vertex without
/// ring has the block 0. `weights` are those of laplacian_weights.
BlockRows laplacian_rows(const Adjacency& rings, std::span<const double> weights,
                         std::span<const Index> rows);

/// The unknowns of a system and their vertices.
struct Unknowns {
  std::vector<Index> vertices;   ///< unknown -> vertex, ascending
  std::vector<Index> of_vertex;  ///< vertex -> unknown, or kNoIndex if it is none

  Unknowns() = default;
  Unknowns(std::vector<Index> list, std::size_t vertex_count);
  std::size_t size() const { return vertices.size(); }
};

/// The places of each unknown in M (or L), and the pattern of M'M over the unknowns. Depends on the
/// region alone, not on positions or weights.
class NormalPattern {
 public:
  /// `M` needs no values.
  NormalPattern(const BlockRows& M, const Unknowns& unknowns);

  const BlockPattern& blocks() const { return blocks_; }

  /// Returns N = M'M + diag(W). W has one number per unknown, or is empty for 0. Gathers over the
  /// rows that two unknowns share, so that one thread sums each block in a fixed order. Reuses
  /// `memory`, of a matrix that is no longer needed.
  BlockMatrix normal_matrix(const BlockRows& M, std::span<const double> W = {},
                            Numbers memory = {}) const;

  /// Returns A x I - G'G, the matrix after eliminating the rotations of the rows G (ENERGY.md
  /// section 5). A is a scalar matrix over the same unknowns. G has 3 x 3 blocks, in the layout of
  /// M. `memory` as above.
  BlockMatrix reduced_matrix(const BlockMatrix& A, const BlockRows& G, Numbers memory = {}) const;

  /// Computes y = M' r over the unknowns: 3 numbers of r per row, 3 of y per unknown. A 1 x 1 block
  /// acts on x, y and z alike.
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

  std::vector<Index> unknown_of_block_;  ///< per block of M, or kNoIndex
  std::vector<std::size_t> entry_starts_;
  std::vector<Entry> entries_;
  BlockPattern blocks_;
};

/// Computes r = M u, or L u for x, y and z. `displacement` has one vector per vertex of the whole
/// mesh, r 3 numbers per row.
void multiply(const BlockRows& M, std::span<const Eigen::Vector3d> displacement,
              std::span<double> r);

}  // namespace lapwing
