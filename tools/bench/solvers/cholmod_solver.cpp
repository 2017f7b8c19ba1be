#include "solvers/cholmod_solver.h"

#include <string>

namespace lapwing::bench {

CholmodSolver::CholmodSolver(CholmodOrdering ordering) {
  cholmod_start(&common_);
  common_.print = 0;
  common_.supernodal = CHOLMOD_SUPERNODAL;
  common_.nmethods = 1;
  common_.postorder = 1;
  common_.method[0].ordering = ordering == CholmodOrdering::amd     ? CHOLMOD_AMD
                               : ordering == CholmodOrdering::metis ? CHOLMOD_METIS
                                                                    : CHOLMOD_GIVEN;
}

CholmodSolver::~CholmodSolver() {
  cholmod_free_factor(&factor_, &common_);
  cholmod_free_dense(&solution_, &common_);
  cholmod_free_dense(&work_y_, &common_);
  cholmod_free_dense(&work_e_, &common_);
  cholmod_finish(&common_);
}

void CholmodSolver::analyze(const BlockPattern& pattern, int block_size,
                            std::span<const int> order) {
  set_pattern(pattern, block_size, order);
  analyze();
}

void CholmodSolver::factorize(const BlockMatrix& matrix) {
  set_values(matrix);
  factorize();
}

void CholmodSolver::solve(std::span<const double> B, std::span<double> X, std::size_t columns) {
  const auto x = solve(B.first(columns * static_cast<std::size_t>(lower_.rows())));
  std::copy(x.begin(), x.end(), X.begin());
}

void CholmodSolver::set_pattern(const BlockPattern& pattern, int block_size,
                                std::span<const int> order) {
  block_size_ = block_size;
  lower_ = scalar_lower_pattern(pattern, block_size);
  order_ = scalar_order(order, block_size);
}

void CholmodSolver::set_values(const BlockMatrix& matrix) {
  fill_scalar_lower(matrix, lower_);
}

void CholmodSolver::analyze() {
  cholmod_free_factor(&factor_, &common_);
  cholmod_sparse view = sparse_view();
  const bool given = common_.method[0].ordering == CHOLMOD_GIVEN;
  factor_ = cholmod_analyze_p(&view, given ? order_.data() : nullptr, nullptr, 0, &common_);
  check("analysis");
}

void CholmodSolver::factorize() {
  cholmod_sparse view = sparse_view();
  cholmod_factorize(&view, factor_, &common_);
  if (common_.status == CHOLMOD_NOT_POSDEF) throw not_positive_definite();
  check("factorization");
}

std::span<const double> CholmodSolver::solve(std::span<const double> B) {
  cholmod_dense b{};
  b.nrow = b.d = static_cast<std::size_t>(lower_.rows());
  b.ncol = B.size() / b.nrow;
  b.nzmax = B.size();
  b.x = const_cast<double*>(B.data());  // CHOLMOD only reads it
  b.xtype = CHOLMOD_REAL;
  b.dtype = CHOLMOD_DOUBLE;
  cholmod_solve2(CHOLMOD_A, factor_, &b, nullptr, &solution_, nullptr, &work_y_, &work_e_,
                 &common_);
  check("solve");
  return {static_cast<const double*>(solution_->x), B.size()};
}

cholmod_sparse CholmodSolver::sparse_view() {
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

NotPositiveDefinite CholmodSolver::not_positive_definite() const {
  const auto* permutation = static_cast<const int*>(factor_->Perm);
  const int scalar = permutation[std::min(factor_->minor, factor_->n - 1)];
  const int block = scalar / block_size_;
  return {"the matrix is not positive definite at block " + std::to_string(block),
          static_cast<Index>(block)};
}

void CholmodSolver::check(const char* step) const {
  if (common_.status >= CHOLMOD_OK) return;
  const char* why = common_.status == CHOLMOD_OUT_OF_MEMORY ? "out of memory"
                    : common_.status == CHOLMOD_TOO_LARGE   ? "the problem is too large"
                                                            : "internal error";
  throw SolverError("CHOLMOD's " + std::string(step) + " failed: " + why + " at " +
                    std::to_string(lower_.rows()) + " unknowns; choose a smaller region");
}

std::unique_ptr<BlockSolver> make_cholmod_solver() {
  return std::make_unique<CholmodSolver>();
}

}  // namespace lapwing::bench
