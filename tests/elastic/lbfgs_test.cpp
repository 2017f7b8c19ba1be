#include <cmath>

#include <Eigen/Core>
#include <Eigen/Eigenvalues>
#include <gtest/gtest.h>

#include "lapwing/elastic/lbfgs_history.h"

namespace lapwing {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

// A quadratic function x' H x / 2 - b' x, whose first Hessian A = I is a poor one.
struct Quadratic {
  explicit Quadratic(Eigen::Index n) : H(MatrixXd::Identity(n, n)), b(n) {
    for (Eigen::Index i = 0; i < n; ++i) {
      b[i] = std::sin(1.0 + static_cast<double>(i));
      H(i, i) = 1.0 / (1.0 + static_cast<double>(i % 7));
      if (i > 0) H(i, i - 1) = H(i - 1, i) = 0.03;
    }
  }
  VectorXd gradient(const VectorXd& x) const { return H * x - b; }

  MatrixXd H;
  VectorXd b;
};

std::span<const double> view(const VectorXd& v) {
  return {v.data(), static_cast<std::size_t>(v.size())};
}
std::span<double> view(VectorXd& v) {
  return {v.data(), static_cast<std::size_t>(v.size())};
}

// Iterations until the gradient is small, with the step that is best along each direction.
int minimize(const Quadratic& f, VectorXd& x, int window, int most) {
  Lbfgs history(static_cast<std::size_t>(x.size()), window);
  VectorXd g = f.gradient(x);
  for (int k = 0; k < most; ++k) {
    if (g.norm() < 1e-6) return k;
    VectorXd p(x.size());
    history.first_loop(view(std::as_const(g)), view(p));
    history.second_loop(view(p));
    const VectorXd next = x - g.dot(p) / p.dot(f.H * p) * p;
    const VectorXd next_g = f.gradient(next);
    history.add(view(std::as_const(x)), view(next), view(std::as_const(g)), view(next_g));
    x = next;
    g = next_g;
  }
  return most;
}

TEST(Lbfgs, WithoutAPastTheDirectionIsTheGradient) {
  Lbfgs history(5, 3);
  const VectorXd x = VectorXd::Zero(5);
  const VectorXd next = VectorXd::Ones(5);
  const VectorXd g = VectorXd::LinSpaced(5, -1.0, 2.0);
  history.add(view(x), view(next), view(x), view(next));
  EXPECT_FALSE(history.is_empty());
  history.forget();
  VectorXd p(5);
  history.first_loop(view(g), view(p));
  history.second_loop(view(p));
  EXPECT_EQ(p, g);
}

// Far below what floats hold.
TEST(Lbfgs, RemembersStepsOfAnyLength) {
  const Quadratic f(20);
  const VectorXd x = VectorXd::Zero(20);
  const VectorXd step = VectorXd::LinSpaced(20, -1.0, 2.0);
  const VectorXd g = f.gradient(x);
  const VectorXd next_g = f.gradient(step);
  const auto direction = [&](double length) {
    Lbfgs history(20, 3, length);
    const VectorXd next = length * step;
    const VectorXd last = length * g;
    const VectorXd now = length * next_g;
    history.add(view(x), view(next), view(last), view(now));
    VectorXd p(20);
    history.first_loop(view(now), view(p));
    history.second_loop(view(p));
    return VectorXd(p / length);
  };
  const VectorXd expected = direction(1.0);
  EXPECT_NE(expected, next_g);
  EXPECT_EQ(direction(std::ldexp(1.0, -200)), expected);
  EXPECT_EQ(direction(std::ldexp(1.0, 200)), expected);
}

// Sizes around the chunks of the loops, and windows that are filled and run over.
TEST(Lbfgs, FindsTheMinimumInFewerStepsThanWithoutAPast) {
  for (const Eigen::Index n : {3, 40, 1100}) {
    const Quadratic f(n);
    VectorXd x = VectorXd::Zero(n);
    const int iterations = minimize(f, x, 8, 500);
    EXPECT_LT(iterations, 60) << n;
    EXPECT_LT((f.H * x - f.b).norm(), 1e-5);
  }
}

// The secant equation of BFGS: the direction for the last change is the last step.
TEST(Lbfgs, TheLastStepIsWhatTheLastChangeAsksFor) {
  const Quadratic f(30);
  Lbfgs history(30, 4);
  VectorXd x = VectorXd::Zero(30);
  for (int k = 0; k < 6; ++k) {
    const VectorXd next = x + VectorXd::Random(30);
    const VectorXd g = f.gradient(x);
    const VectorXd next_g = f.gradient(next);
    history.add(view(std::as_const(x)), view(next), view(g), view(next_g));
    const VectorXd change = next_g - g;
    VectorXd p(30);
    history.first_loop(view(change), view(p));
    history.second_loop(view(p));
    EXPECT_LT((p - (next - x)).norm(), 1e-5 * (next - x).norm()) << "step " << k;
    x = next;
  }
}

TEST(Lbfgs, AStepWithoutCurvatureIsLeftOut) {
  Lbfgs history(4, 2);
  const VectorXd x = VectorXd::Zero(4);
  const VectorXd next = VectorXd::Ones(4);
  const VectorXd g = VectorXd::Constant(4, 2.0);
  const VectorXd smaller = VectorXd::Constant(4, 1.0);
  history.add(view(x), view(next), view(g), view(smaller));
  EXPECT_TRUE(history.is_empty());
}

}  // namespace
}  // namespace lapwing
