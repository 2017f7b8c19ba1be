#include <string>

#include <cholmod.h>

#include "lapwing/base/errors.h"
#include "lapwing/solve/ordering.h"
#include "solvers/peer_solvers.h"
#include "solvers/scalar_lower.h"

namespace lapwing::bench {
namespace {

class CholmodSolver final : public BlockSolver {
 public:
  CholmodSolver() {
    cholmod_start(&common_);
    common_.print = 0;
    common_.supernodal = CHOLMOD_SUPERNODAL;
    common_.nmethods = 1;
    common_.postorder = 1;
    common_.method[0].ordering = CHOLMOD_GIVEN;
  }
  CholmodSolver(const CholmodSolver&) = delete;
  CholmodSolver& operator=(const CholmodSolver&) = delete;
  ~CholmodSolver() override {
    cholmod_free_factor(&factor_, &common_);
    cholmod_free_dense(&solution_, &common_);
    cholmod_free_dense(&work_y_, &common_);
    cholmod_free_dense(&work_e_, &common_);
    cholmod_finish(&common_);
  }

  std::string_view name() const override { return "CHOLMOD"; }

  void analyze(const BlockPattern& pattern, int block_size, std::span<const int> order) override {
    block_size_ = block_size;
    lower_ = scalar_lower_pattern(pattern, block_size);
    std::vector<int> scalar = scalar_order(order, block_size);
    cholmod_free_factor(&factor_, &common_);
    cholmod_sparse view = sparse_view();
    factor_ = cholmod_analyze_p(&view, scalar.data(), nullptr, 0, &common_);
    check("analysis");
  }

  void factorize(const BlockMatrix& matrix) override {
    fill_scalar_lower(matrix, lower_);
    cholmod_sparse view = sparse_view();
    cholmod_factorize(&view, factor_, &common_);
    if (common_.status == CHOLMOD_NOT_POSDEF) throw not_positive_definite();
    check("factorization");
  }

  void solve(std::span<const double> B, std::span<double> X, std::size_t columns) override {
    cholmod_dense b{};
    b.nrow = b.d = static_cast<std::size_t>(lower_.rows());
    b.ncol = columns;
    b.nzmax = b.nrow * columns;
    b.x = const_cast<double*>(B.data());  // CHOLMOD only reads it
    b.xtype = CHOLMOD_REAL;
    b.dtype = CHOLMOD_DOUBLE;
    cholmod_solve2(CHOLMOD_A, factor_, &b, nullptr, &solution_, nullptr, &work_y_, &work_e_,
                   &common_);
    check("solve");
    std::copy_n(static_cast<const double*>(solution_->x), b.nzmax, X.begin());
  }

 private:
  cholmod_sparse sparse_view() {
    cholmod_sparse view{};
    view.nrow = view.ncol = static_cast<std::size_t>(lower_.rows());
    view.nzmax = static_cast<std::size_t>(lower_.nonZeros());
    view.p = lower_.outerIndexPtr();
    view.i = lower_.innerIndexPtr();
    view.x = lower_.valuePtr();
    view.stype = -1;
    view.itype = CHOLMOD_INT;
    view.xtype = CHOLMOD_REAL;
    view.dtype = CHOLMOD_DOUBLE;
    view.sorted = view.packed = 1;
    return view;
  }

  NotPositiveDefinite not_positive_definite() const {
    const auto* permutation = static_cast<const int*>(factor_->Perm);
    const int scalar = permutation[std::min(factor_->minor, factor_->n - 1)];
    const int block = scalar / block_size_;
    return {"the matrix is not positive definite at block " + std::to_string(block),
            static_cast<Index>(block)};
  }

  void check(const char* step) const {
    if (common_.status >= CHOLMOD_OK) return;
    const char* why = common_.status == CHOLMOD_OUT_OF_MEMORY ? "out of memory"
                      : common_.status == CHOLMOD_TOO_LARGE   ? "the problem is too large"
                                                              : "internal error";
    throw SolverError("CHOLMOD's " + std::string(step) + " failed: " + why + " at " +
                      std::to_string(lower_.rows()) + " unknowns; choose a smaller region");
  }

  cholmod_common common_{};
  int block_size_ = 3;
  ScalarLower lower_;
  cholmod_factor* factor_ = nullptr;
  cholmod_dense* solution_ = nullptr;
  cholmod_dense* work_y_ = nullptr;
  cholmod_dense* work_e_ = nullptr;
};

}  // namespace

std::unique_ptr<BlockSolver> make_cholmod_solver() {
  return std::make_unique<CholmodSolver>();
}

}  // namespace lapwing::bench
