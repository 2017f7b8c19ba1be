#include "lapwing/settle/anderson.h"

#include <algorithm>

#include <Eigen/Cholesky>
#include <Eigen/Core>

namespace lapwing {
namespace {

constexpr int kLargestWindow = 8;
// Differences that are nearly parallel say nothing: this much of their size is added to each.
constexpr double kRegularization = 1e-12;

using Vector = Eigen::Map<Eigen::VectorXd>;
using ConstVector = Eigen::Map<const Eigen::VectorXd>;

Vector as_vector(std::span<double> v) {
  return {v.data(), static_cast<Eigen::Index>(v.size())};
}
ConstVector as_vector(std::span<const double> v) {
  return {v.data(), static_cast<Eigen::Index>(v.size())};
}

}  // namespace

Anderson::Anderson(std::size_t size, int window)
    : size_(size),
      window_(std::clamp(window, 1, kLargestWindow)),
      last_g_(size),
      last_residual_(size),
      g_differences_(size * static_cast<std::size_t>(window_)),
      residual_differences_(size * static_cast<std::size_t>(window_)) {}

void Anderson::advance(std::span<double> x, std::span<const double> g) {
  const ConstVector new_g = as_vector(g);
  Vector current = as_vector(x);
  Vector last_g = as_vector(std::span(last_g_));
  Vector residual = as_vector(std::span(last_residual_));
  if (has_last_) {
    as_vector(column(g_differences_, newest_)) = new_g - last_g;
    as_vector(column(residual_differences_, newest_)) = new_g - current - residual;
    newest_ = (newest_ + 1) % window_;
    used_ = std::min(used_ + 1, window_);
  }
  last_g = new_g;
  residual = new_g - current;
  has_last_ = true;
  current = new_g;
  if (used_ == 0) return;

  Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, kLargestWindow, kLargestWindow> A(used_,
                                                                                             used_);
  Eigen::Matrix<double, Eigen::Dynamic, 1, 0, kLargestWindow, 1> b(used_);
  for (int i = 0; i < used_; ++i) {
    const Vector d_i = as_vector(column(residual_differences_, i));
    b[i] = d_i.dot(residual);
    for (int j = 0; j <= i; ++j) {
      A(i, j) = A(j, i) = d_i.dot(as_vector(column(residual_differences_, j)));
    }
  }
  for (int i = 0; i < used_; ++i) A(i, i) *= 1.0 + kRegularization;
  const auto ldlt = A.ldlt();
  b = ldlt.solve(b).eval();
  if (!b.allFinite()) return;
  for (int i = 0; i < used_; ++i) current -= b[i] * as_vector(column(g_differences_, i));
}

}  // namespace lapwing
