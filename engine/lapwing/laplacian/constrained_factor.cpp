#include "lapwing/laplacian/constrained_factor.h"

#include <algorithm>
#include <utility>

namespace lapwing {
namespace {

// Sets the progress callback of a solver for the lifetime of this object.
class Reporting {
 public:
  Reporting(BlockSolver& solver, const Progress& progress) : solver_(solver) {
    solver_.set_progress(progress);
  }
  Reporting(const Reporting&) = delete;
  Reporting& operator=(const Reporting&) = delete;
  ~Reporting() { solver_.set_progress({}); }

 private:
  BlockSolver& solver_;
};

}  // namespace

ConstrainedFactor::ConstrainedFactor(const SystemPattern& pattern, int block_size,
                                     FactorPrecision precision)
    : pattern_(pattern), block_size_(block_size), solver_(make_solver(precision)) {}

void ConstrainedFactor::analyze() {
  if (block_size_ == 1) return analyze(pattern_.order());
  if (!analyzed_) solver_->analyze_as(pattern_.analysis());
  analyzed_ = true;
}

void ConstrainedFactor::analyze(std::span<const int> order) {
  if (analyzed_) return;
  solver_->analyze(pattern_.blocks(), block_size_, order);
  analyzed_ = true;
}

void ConstrainedFactor::analyze_as(const ConstrainedFactor& other) {
  solver_->analyze_as(other.solver_->analysis());
  analyzed_ = true;
}

void ConstrainedFactor::set_matrix(BlockMatrix A) {
  factored_ = false;
  A_ = std::move(A);
  W_.assign(A_.pattern->size(), 0.0);
  const auto b = static_cast<std::size_t>(A_.block_size);
  diagonal_.resize(A_.scalar_size());
  for (std::size_t u = 0; u < W_.size(); ++u) {
    const auto block = A_.block(A_.pattern->starts[u]);
    for (std::size_t k = 0; k < b; ++k) diagonal_[b * u + k] = block[(b + 1) * k];
  }
}

BlockMatrix ConstrainedFactor::unconstrained_matrix() const {
  BlockMatrix A = A_;
  const auto b = static_cast<std::size_t>(A.block_size);
  for (std::size_t u = 0; u < W_.size(); ++u) {
    double* block = A.values.data() + b * b * A.pattern->starts[u];
    for (std::size_t k = 0; k < b; ++k) block[(b + 1) * k] = diagonal_[b * u + k];
  }
  return A;
}

Numbers ConstrainedFactor::take_memory() {
  factored_ = false;
  return std::exchange(A_.values, {});
}

void ConstrainedFactor::hold(std::size_t unknown, double weight) {
  const auto b = static_cast<std::size_t>(A_.block_size);
  double* block = A_.values.data() + b * b * A_.pattern->starts[unknown];
  for (std::size_t k = 0; k < b; ++k) block[(b + 1) * k] = diagonal_[b * unknown + k] + weight;
  W_[unknown] = weight;
}

bool ConstrainedFactor::is_factorized_for(std::span<const double> W) const {
  return factored_ && std::equal(W.begin(), W.end(), W_.begin(), W_.end());
}

void ConstrainedFactor::factorize(std::span<const double> W, const Progress& progress) {
  if (is_factorized_for(W)) return;
  std::vector<Index> changed;
  for (std::size_t u = 0; u < W_.size(); ++u) {
    if (W[u] == W_[u]) continue;
    hold(u, W[u]);
    changed.push_back(static_cast<Index>(u));
  }
  const bool anew = !factored_;
  factored_ = false;
  const Reporting reporting(*solver_, progress);
  if (anew) {
    solver_->factorize(A_);
  } else {
    solver_->refactorize_diagonal(A_, changed);
  }
  factored_ = true;
}

}  // namespace lapwing
