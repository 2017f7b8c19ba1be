#include "lapwing/elastic/pose_hessian.h"

#include <cmath>
#include <utility>

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <Eigen/QR>

#include "lapwing/base/limits.h"
#include "lapwing/base/parallel.h"
#include "lapwing/base/worker_pool.h"
#include "lapwing/elastic/response_system.h"
#include "lapwing/laplacian/ring_fit.h"
#include "lapwing/laplacian/rotation.h"

namespace lapwing {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using Eigen::VectorXd;

// The square root of beta. The Hessian contains A / 1000, so a step is at most 1000 times longer
// than with the n x n factor. Without this term, compressed rings would have almost no stiffness.
const double kRootOfBeta = std::sqrt(1.0 - 1e-3);

Matrix3d rotation_stiffness(const Matrix3d& S) {
  return S.trace() * Matrix3d::Identity() - S;
}

// Factors that convert the blocks of G_i at rest to those at a pose.
struct BlockFactors {
  Matrix3d left;
  Matrix3d right;
};

// T = R S is the transform of row `r` of the rings, and its stretched rest edges are S e. The
// blocks a_i at the pose follow from those at rest because [S e]x = det(S) S^-1 [e]x S^-1. F_i F_i'
// is K_i at the pose in the coordinates of the ring, but in every direction at least that of the
// stretched rest shape.
BlockFactors pose_factors(const RegionRings& rings, std::size_t r, const Matrix3d& T,
                          std::span<const Vector3d> displacement) {
  Matrix3d at_rest = Matrix3d::Zero();
  Matrix3d C = Matrix3d::Zero();
  Vector3d delta = Vector3d::Zero();
  Vector3d moved = Vector3d::Zero();
  for (Index k = rings.starts[r]; k < rings.starts[r + 1]; ++k) {
    const Vector3d e = -rings.edges[k];
    const Vector3d now = e + displacement[r] - displacement[rings.neighbours[k]];
    if (!rings.stiffness.empty()) {
      at_rest += rings.stiffness[k] * e * e.transpose();
      C += rings.stiffness[k] * now * e.transpose();
    }
    delta += rings.weights[k] * e;
    moved += rings.weights[k] * now;
  }
  at_rest += rings.row_weights[r] * delta * delta.transpose();
  C += rings.row_weights[r] * moved * delta.transpose();

  constexpr double kRigid = 1e-12;
  const bool is_stretched = (T.transpose() * T - Matrix3d::Identity()).norm() > kRigid;
  const Matrix3d S = is_stretched ? polar_stretch(T) : Matrix3d(Matrix3d::Identity());
  const Matrix3d inverse_S = is_stretched ? Matrix3d(S.inverse()) : S;
  const Matrix3d R = T * inverse_S;
  const Matrix3d Q = R.transpose() * C * S;
  const Matrix3d inverse_F = inverse_cholesky_factor(rotation_stiffness(S * at_rest * S));
  Eigen::SelfAdjointEigenSolver<Matrix3d> ratio;  // computeDirect is less accurate but fast
  ratio.computeDirect(inverse_F * rotation_stiffness(0.5 * (Q + Q.transpose())) *
                      inverse_F.transpose());
  const Vector3d inverse_roots = ratio.eigenvalues().cwiseMax(1.0).cwiseSqrt().cwiseInverse();
  BlockFactors factors{
      ratio.eigenvectors() * inverse_roots.asDiagonal() * ratio.eigenvectors().transpose(),
      kRootOfBeta * inverse_S * R.transpose()};
  if (is_stretched) {
    // If a rotation has no effect, G_i at rest has a row of zeros, so any inverse can be used.
    const Matrix3d F = inverse_cholesky_factor(rotation_stiffness(at_rest))
                           .completeOrthogonalDecomposition()
                           .pseudoInverse();
    factors.left *= S.determinant() * inverse_F * inverse_S * F;
  }
  return factors;
}

std::span<double> numbers(VectorXd& vector) {
  return {vector.data(), static_cast<std::size_t>(vector.size())};
}

}  // namespace

PoseHessian::PoseHessian(const Topology& topology, std::span<const Index> roi,
                         const SystemPattern& pattern, const LaplacianSystem& laplacian,
                         const DeformOptions& options, AtRest at_rest)
    : topology_(topology),
      pattern_(pattern),
      laplacian_(laplacian),
      make_at_rest_(std::move(at_rest)),
      memory_limit_(options.memory_limit_bytes),
      roi_(roi.begin(), roi.end()),
      b_(3 * laplacian.size()),
      x_(b_.size()) {}

void PoseHessian::prepare() {
  const std::scoped_lock lock(taking_);
  if (factor_ != nullptr) return;
  prepared_.begin([this] {
    const SerialScope alone;  // the other threads are needed for the frames
    std::unique_ptr<ConstrainedFactor> factor = analyzed_factor();
    if (factor != nullptr) factor->solver().prepare_memory();
    return factor;
  });
}

// Returns null if the memory does not suffice.
std::unique_ptr<ConstrainedFactor> PoseHessian::analyzed_factor() const {
  auto factor = std::make_unique<ConstrainedFactor>(pattern_, 3, FactorPrecision::float32);
  factor->analyze();
  return fits(*factor) ? std::move(factor) : nullptr;
}

bool PoseHessian::fits(const ConstrainedFactor& factor) const {
  // Of the matrix; below, of G at rest and at the pose.
  std::size_t blocks = pattern_.blocks().rows.size();
  for (const Index v : roi_) blocks += 2 * (1 + topology_.rings.size(v));
  const std::size_t bytes = 9 * sizeof(double) * blocks + factor.solver().statistics().peak_bytes;
  return bytes <= allowed_memory(memory_limit_);
}

bool PoseHessian::take_memory() {
  if (factor_ != nullptr) return true;
  const std::scoped_lock lock(taking_);
  std::unique_ptr<ConstrainedFactor> factor =
      prepared_.is_pending() ? prepared_.take() : analyzed_factor();
  if (factor == nullptr) return false;
  const RegionRings& rings = laplacian_.rings();
  const std::vector<Index> row_of_vertex = inverse_index(
      std::span(rings.vertices).first(rings.row_count()), topology_.rings.row_count());
  row_of_.clear();
  for (const Index v : roi_) row_of_.push_back(row_of_vertex[v]);
  at_rest_ = make_at_rest_();
  turned_ = rsi_rows(topology_.rings, roi_);
  factor_ = std::move(factor);
  return true;
}

bool PoseHessian::factorize(std::span<const Matrix3d> transforms,
                            std::span<const Vector3d> displacement) {
  constexpr std::size_t kRowsPerTask = 512;
  if (!take_memory()) return false;
  const RegionRings& rings = laplacian_.rings();
  const BlockRows& at_rest = *at_rest_;
  parallel_for(roi_.size(), kRowsPerTask, [&](std::size_t begin, std::size_t end) {
    for (std::size_t r = begin; r < end; ++r) {
      const BlockFactors factors =
          pose_factors(rings, row_of_[r], transforms[row_of_[r]], displacement);
      for (std::size_t b = at_rest.starts[r]; b < at_rest.starts[r + 1]; ++b) {
        Eigen::Map<Matrix3d>(turned_.values.data() + 9 * b).noalias() =
            factors.left * Eigen::Map<const Matrix3d>(at_rest.values.data() + 9 * b) *
            factors.right;
      }
    }
  });
  is_solved_ = false;
  doubles_.reset();
  factor_->set_matrix(energy_hessian(pattern_, laplacian_, turned_, factor_->take_memory()));
  return is_factored(*factor_) || factor_in_doubles();
}

bool PoseHessian::is_factored(ConstrainedFactor& factor) const {
  try {
    factor.factorize(laplacian_.constraints().W);
  } catch (const NotPositiveDefinite&) {
    return false;
  }
  return true;
}

// Returns false if the memory does not suffice, or if the matrix is indefinite in double precision,
// too.
bool PoseHessian::factor_in_doubles() {
  auto doubles = std::make_unique<ConstrainedFactor>(pattern_, 3);
  doubles->analyze_as(*factor_);
  if (!fits(*doubles)) return false;
  doubles->set_matrix(factor_->unconstrained_matrix());
  if (!is_factored(*doubles)) return false;
  doubles_ = std::move(doubles);
  return true;
}

// Copies `b` to b_. Returns true if b_ already had these values.
bool PoseHessian::read(std::span<const double> b) {
  const std::vector<int>& order = laplacian_.elimination_order();
  const std::size_t n = order.size();
  bool is_same = true;
  for (std::size_t k = 0; k < n; ++k) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      double& number = b_[3 * static_cast<std::size_t>(order[k]) + axis];
      is_same = is_same && number == b[axis * n + k];
      number = b[axis * n + k];
    }
  }
  return is_same;
}

void PoseHessian::write(std::span<double> b) const {
  const std::vector<int>& order = laplacian_.elimination_order();
  const std::size_t n = order.size();
  for (std::size_t k = 0; k < n; ++k) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      b[axis * n + k] = x_[3 * static_cast<std::size_t>(order[k]) + axis];
    }
  }
}

void PoseHessian::solve_in_place(std::span<double> b) {
  read(b);
  in_use().solver().solve(b_, x_, 1);
  is_solved_ = true;
  write(b);
}

void PoseHessian::solve_accurately_in_place(std::span<double> b) {
  if (!read(b) || !is_solved_) in_use().solver().solve(b_, x_, 1);
  if (doubles_ == nullptr) refine();
  is_solved_ = false;
  write(b);
}

// Refines x_, which the factor gave for the right-hand side b_. In single precision, it has large
// errors only in a few soft directions. If one step of iterative refinement is small, applies this
// step. Otherwise applies conjugate gradients, preconditioned by the factor, until the estimated
// error is small.
void PoseHessian::refine() {
  constexpr int kMostSteps = 8;
  constexpr double kGood = 0.1;  // estimated error divided by the largest entry of x
  const auto n = static_cast<Eigen::Index>(b_.size());
  Eigen::Map<VectorXd> x(x_.data(), n);
  const auto is_good = [&](double change, double last_change) {
    return change * change <= kGood * last_change * x.lpNorm<Eigen::Infinity>();
  };
  VectorXd product(n);
  multiply(in_use().matrix(), x_, numbers(product), 1);
  VectorXd residual = Eigen::Map<const VectorXd>(b_.data(), n) - product;
  VectorXd preconditioned(n);
  in_use().solver().solve(numbers(residual), numbers(preconditioned), 1);
  if (is_good(preconditioned.lpNorm<Eigen::Infinity>(), x.lpNorm<Eigen::Infinity>())) {
    x += preconditioned;
    return;
  }
  VectorXd direction = preconditioned;
  double slope = residual.dot(preconditioned);
  double last_change = 0.0;
  for (int k = 0; k < kMostSteps; ++k) {
    multiply(in_use().matrix(), numbers(direction), numbers(product), 1);
    const double length = slope / direction.dot(product);
    x += length * direction;
    residual -= length * product;
    const double change = length * direction.lpNorm<Eigen::Infinity>();
    if (is_good(change, last_change)) return;
    last_change = change;
    in_use().solver().solve(numbers(residual), numbers(preconditioned), 1);
    const double last_slope = std::exchange(slope, residual.dot(preconditioned));
    direction = preconditioned + slope / last_slope * direction;
  }
}

}  // namespace lapwing
