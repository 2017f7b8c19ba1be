#pragma once

#include <cholmod.h>

#include "lapwing/solve/scalar_lower.h"
#include "solvers/peer_solvers.h"

namespace lapwing::bench {

/// CHOLMOD's supernodal Cholesky as a BlockSolver. Each step is also public without the conversions
/// that BlockSolver adds, to time it alone.
class CholmodSolver final : public BlockSolver {
 public:
  explicit CholmodSolver(CholmodOrdering ordering = CholmodOrdering::blocks);
  CholmodSolver(const CholmodSolver&) = delete;
  CholmodSolver& operator=(const CholmodSolver&) = delete;
  ~CholmodSolver() override;

  std::string_view name() const override { return "CHOLMOD"; }
  void analyze(const BlockPattern& pattern, int block_size, std::span<const int> order) override;
  void factorize(const BlockMatrix& matrix) override;
  void solve(std::span<const double> B, std::span<double> X, std::size_t columns) override;

  /// `order` is that of the blocks; ignored if CHOLMOD orders by itself.
  void set_pattern(const BlockPattern& pattern, int block_size, std::span<const int> order);
  void set_values(const BlockMatrix& matrix);
  /// The steps of BlockSolver, after the two functions above.
  void analyze();
  void factorize();
  /// The view is valid until the next solve.
  std::span<const double> solve(std::span<const double> B);
  std::size_t factor_bytes() const { return factor_->xsize * sizeof(double); }

 private:
  cholmod_sparse sparse_view();
  NotPositiveDefinite not_positive_definite() const;
  void check(const char* step) const;

  cholmod_common common_{};
  int block_size_ = 3;
  std::vector<int> order_;
  ScalarLower lower_;
  cholmod_factor* factor_ = nullptr;
  cholmod_dense* solution_ = nullptr;
  cholmod_dense* work_y_ = nullptr;
  cholmod_dense* work_e_ = nullptr;
};

}  // namespace lapwing::bench
