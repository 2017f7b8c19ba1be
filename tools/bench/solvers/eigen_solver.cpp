#include <Eigen/SparseCholesky>

#include "lapwing/solve/ordering.h"
#include "solvers/peer_solvers.h"
#include "solvers/scalar_lower.h"

namespace lapwing::bench {
namespace {

// Eigen's ordering does nothing, because the matrix is permuted by ours already.
class Simplicial final
    : public Eigen::SimplicialLLT<ScalarLower, Eigen::Lower, Eigen::NaturalOrdering<int>> {
 public:
  // After a failed factorization, the columns that it did not reach have 0 on the diagonal.
  void clear() { m_matrix.coeffs().setZero(); }
};
using Permutation = Eigen::PermutationMatrix<Eigen::Dynamic, Eigen::Dynamic, int>;

class EigenSolver final : public BlockSolver {
 public:
  std::string_view name() const override { return "Eigen"; }

  void analyze(const BlockPattern& pattern, int block_size, std::span<const int> order) override {
    block_size_ = block_size;
    order_.assign(order.begin(), order.end());
    const std::vector<int> scalar = scalar_order(order, block_size);
    new_to_old_.indices() =
        Eigen::Map<const Eigen::VectorXi>(scalar.data(), static_cast<Eigen::Index>(scalar.size()));
    lower_ = scalar_lower_pattern(pattern, block_size);
    permute();
    factor_.analyzePattern(permuted_);
  }

  void factorize(const BlockMatrix& matrix) override {
    fill_scalar_lower(matrix, lower_);
    permute();
    factor_.clear();
    factor_.factorize(permuted_);
    if (factor_.info() != Eigen::Success) throw not_positive_definite();
  }

  void solve(std::span<const double> B, std::span<double> X, std::size_t columns) override {
    const auto n = lower_.rows();
    const auto k = static_cast<Eigen::Index>(columns);
    const Eigen::MatrixXd b =
        new_to_old_.transpose() * Eigen::Map<const Eigen::MatrixXd>(B.data(), n, k);
    Eigen::Map<Eigen::MatrixXd>(X.data(), n, k) = new_to_old_ * factor_.solve(b);
  }

 private:
  void permute() {
    permuted_.resize(lower_.rows(), lower_.cols());
    permuted_.selfadjointView<Eigen::Lower>() =
        lower_.selfadjointView<Eigen::Lower>().twistedBy(new_to_old_.inverse());
  }

  // Eigen does not say where the pivot failed: it stops at the first column whose diagonal entry
  // of the partial factor is not a positive number.
  NotPositiveDefinite not_positive_definite() const {
    const auto& L = factor_.matrixL().nestedExpression();
    int column = 0;
    while (column + 1 < static_cast<int>(L.cols()) &&
           L.valuePtr()[L.outerIndexPtr()[column]] > 0.0) {
      ++column;
    }
    const int block = order_[static_cast<std::size_t>(column / block_size_)];
    return {"the matrix is not positive definite at block " + std::to_string(block),
            static_cast<Index>(block)};
  }

  int block_size_ = 3;
  std::vector<int> order_;
  Permutation new_to_old_;
  ScalarLower lower_;
  ScalarLower permuted_;
  Simplicial factor_;
};

}  // namespace

std::unique_ptr<BlockSolver> make_eigen_solver() {
  return std::make_unique<EigenSolver>();
}

}  // namespace lapwing::bench
