#pragma once

#include <cstddef>
#include <memory>
#include <mutex>
#include <span>
#include <string_view>
#include <vector>

#include "lapwing/base/instruction_set.h"
#include "lapwing/base/worker_pool.h"
#include "lapwing/solve/block_solver.h"

namespace lapwing {
namespace cholesky {
struct KernelTables;
}

struct BlockCholeskyOptions {
  unsigned threads = 0;  ///< 0: all CPU cores that this process may use
  /// Results of different instruction sets differ by rounding errors.
  InstructionSet instruction_set = InstructionSet::automatic;
  std::size_t memory_limit_bytes = 0;  ///< `analyze` throws if more memory is needed; 0: no limit
  FactorPrecision precision = FactorPrecision::float64;
};

/// Multifrontal Cholesky factorization of matrices in 1 x 1 or 3 x 3 blocks, on several threads.
/// The symbolic phase works on blocks and is shared by both precisions. The numeric phase works on
/// dense fronts, with kernels for the CPU's vector instructions. Results are bitwise identical for
/// every run and every number of threads.
///
/// If `factorize` or `refactorize_diagonal` throws (NotPositiveDefinite, Cancelled), the analysis
/// remains valid, and `factorize` may be called again.
class BlockCholesky final : public BlockSolver {
 public:
  /// Throws SolverError if the CPU does not support the instruction set.
  explicit BlockCholesky(const BlockCholeskyOptions& options = {});
  ~BlockCholesky() override;

  std::string_view name() const override { return "Lapwing block Cholesky"; }

  /// Throws SolverError if `order` is not a permutation, or if the factorization needs more than
  /// the memory limit. Uses little memory itself until this check has passed.
  void analyze(const BlockPattern& pattern, int block_size, std::span<const int> order) override;

  std::shared_ptr<const SolverAnalysis> analysis() const override;

  /// Throws SolverError also if the factorization needs more than the memory limit.
  void analyze_as(std::shared_ptr<const SolverAnalysis> analysis) override;

  /// Throws SolverError if there is no analysis or not enough memory.
  void prepare_memory() override;

  /// Throws SolverError if an entry is not finite, and NotPositiveDefinite if a pivot is rejected;
  /// the message names the block. Throws Cancelled. The first call allocates all memory, unless
  /// `prepare_memory` has done so.
  void factorize(const BlockMatrix& matrix) override;

  /// Recomputes only the tasks (groups of subtrees) that contain changed blocks, and the fronts
  /// above them.
  void refactorize_diagonal(const BlockMatrix& matrix, std::span<const Index> changed) override;

  void solve(std::span<const double> B, std::span<double> X, std::size_t columns) override;

  void solve_in_places(std::span<double> X, std::size_t columns,
                       std::span<const Index> places) override;

  SolverStatistics statistics() const override { return statistics_; }

 private:
  struct Analysis;
  class Factorization;
  template <typename Real>
  class FactorizationIn;
  template <typename Step>
  void guard(Step step);
  void use(std::shared_ptr<const Analysis> analysis);
  void factorize(const BlockMatrix& matrix, const std::vector<char>& kept);
  void solve(std::span<const double> B, std::span<double> X, std::size_t columns,
             std::span<const Index> places);
  void forget();
  void take_memory();
  void require_memory_for_factor() const;
  void require_analysis() const;
  void check(const BlockMatrix& matrix) const;

  BlockCholeskyOptions options_;
  const cholesky::KernelTables& kernels_;
  std::unique_ptr<WorkerPool> own_pool_;
  WorkerPool& pool_;
  SolverStatistics statistics_;
  std::shared_ptr<const Analysis> analysis_;
  std::unique_ptr<Factorization> factorization_;
  std::mutex solving_;
  bool factored_ = false;
};

}  // namespace lapwing
