#pragma once

#include <cstddef>
#include <memory>
#include <span>
#include <string_view>

#include "lapwing/base/instruction_set.h"
#include "lapwing/solve/block_solver.h"

namespace lapwing {

/// How a BlockCholesky works.
struct BlockCholeskyOptions {
  unsigned threads = 0;  ///< 0 for all processors that this process may run on
  /// Results of different sets differ in last bits.
  InstructionSet instruction_set = InstructionSet::automatic;
  std::size_t memory_limit_bytes = 0;  ///< `analyze` throws when more would be needed; 0: no limit
  FactorPrecision precision = FactorPrecision::float64;
};

/// Multifrontal Cholesky factorization of matrices in 1 x 1 or 3 x 3 blocks, on several threads.
/// Symbolic work is done on blocks, and serves either precision, numeric work in dense fronts with
/// kernels for the processor's vector instructions. Same input, same bits, for every number of
/// threads and on every run.
///
/// After a throw from `factor` or `refactor_diagonal` (NotPositiveDefinite, Cancelled) the analysis
/// is still good and `factor` may be called again.
class BlockCholesky final : public BlockSolver {
 public:
  /// Throws SolverError when the processor lacks the instruction set asked for.
  explicit BlockCholesky(const BlockCholeskyOptions& options = {});
  ~BlockCholesky() override;

  std::string_view name() const override { return "Lapwing block Cholesky"; }

  /// Throws SolverError when `order` is no permutation, or when more than the memory limit would
  /// be needed; takes next to no memory itself before that is known.
  void analyze(const BlockPattern& pattern, int block_size, std::span<const int> order) override;

  std::shared_ptr<const SolverAnalysis> analysis() const override;

  /// Throws SolverError also when more than the memory limit would be needed.
  void analyze_as(std::shared_ptr<const SolverAnalysis> analysis) override;

  /// Throws SolverError when there is no analysis, or not the memory.
  void prepare_memory() override;

  /// Throws SolverError, naming the block, when a number is not finite; NotPositiveDefinite, naming
  /// block and component, when a pivot is refused; Cancelled. All memory is taken in the first
  /// call, or by `prepare_memory`.
  void factor(const BlockMatrix& matrix) override;

  /// Redoes the subtrees that hold the changed blocks and the fronts above them.
  void refactor_diagonal(const BlockMatrix& matrix, std::span<const Index> changed) override;

  void solve(std::span<const double> B, std::span<double> X, std::size_t columns) override;

  void solve_in_places(std::span<double> X, std::size_t columns,
                       std::span<const Index> places) override;

  SolverStatistics statistics() const override;

 private:
  class Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace lapwing
