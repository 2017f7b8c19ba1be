#pragma once

#include <map>
#include <memory>
#include <random>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "lapwing/mesh/topology.h"
#include "lapwing/solve/block_matrix.h"
#include "lapwing/solve/block_solver.h"

namespace lapwing::test {

/// What the residual of a solution may be, against matrix and solution.
inline constexpr double kBackwardError = 1e-14;
/// Where the factor is held in floats.
inline constexpr double kBackwardErrorOfFloats = 3e-6;

/// A block matrix together with the pattern that it needs.
struct OwnedMatrix {
  std::unique_ptr<BlockPattern> pattern;
  BlockMatrix matrix;
};

/// Collects scalar entries (row, column) of a symmetric matrix; those of the lower block triangle
/// make the matrix. Diagonal blocks are always there.
class MatrixBuilder {
 public:
  MatrixBuilder(std::size_t blocks, int block_size);
  void add(std::size_t row, std::size_t column, double value);
  OwnedMatrix build() const;

 private:
  std::size_t block_size_;
  std::vector<std::map<Index, std::vector<double>>> columns_;
};

/// A random symmetric pattern of `blocks` blocks with about `degree` off-diagonal blocks a row, and
/// values that make it diagonally dominant by the factor 1 + `margin`.
OwnedMatrix random_matrix(std::size_t blocks, int block_size, double degree, double margin,
                          unsigned seed);

/// A dense random matrix X X' with X square: conditioned like a random matrix squared.
OwnedMatrix dense_matrix(std::size_t blocks, int block_size, unsigned seed);

/// L'L + W of a mesh: uniform Laplacian, W = `weight` at every `step`-th vertex, none for step 0.
OwnedMatrix laplacian_matrix(const Mesh& mesh, double weight, std::size_t step);

/// The RSI normal matrix M'M + W in 3 x 3 blocks, W as in `laplacian_matrix`.
OwnedMatrix rsi_matrix(const Mesh& mesh, double weight, std::size_t step);

/// The same over a region (ascending), W given for each of its vertices; the rest stays.
OwnedMatrix rsi_matrix(const Mesh& mesh, const std::vector<Index>& roi, std::span<const double> W);

/// S A S with a diagonal S of entries 10^-(0..decades): badly scaled, as positive definite as A.
void scale_badly(BlockMatrix& matrix, double decades, unsigned seed);

/// Adds `value` to the diagonal of block `block`.
void add_to_diagonal(BlockMatrix& matrix, Index block, double value);

/// `count` numbers between -1 and 1.
std::vector<double> random_vector(std::size_t count, unsigned seed);

/// |A x - b| / (|A| |x| + |b|), in the maximum norm, the worst of `columns` columns.
double backward_error(const BlockMatrix& A, std::span<const double> x, std::span<const double> b,
                      std::size_t columns = 1);

/// Analyzes (minimum degree), factors and solves for `b`.
std::vector<double> solve_with(BlockSolver& solver, const BlockMatrix& A, std::span<const double> b,
                               std::size_t columns = 1);

}  // namespace lapwing::test
