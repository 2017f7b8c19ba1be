#include "lapwing/parameterize/radial_basis_field.h"

#include <cmath>

#include <Eigen/Cholesky>

namespace lapwing {
namespace {

using Eigen::Vector2d;
using Place = DomainChart::Place;

// Returns phi(s) for q = 1 / s. The series avoids cancellation in 1 - ln(1 + q) / q.
double profile(double q) {
  if (q > 0.02) return 1.0 - std::log1p(q) / q;
  return q *
         (1.0 / 2 -
          q * (1.0 / 3 - q * (1.0 / 4 - q * (1.0 / 5 - q * (1.0 / 6 - q * (1.0 / 7 - q / 8))))));
}

double kernel(const Place& z, const Place& w) {
  const double squared = (z.z - w.z).squaredNorm();
  return squared > 0.0 ? profile(z.clearance * w.clearance / squared) : 1.0;
}

}  // namespace

RadialBasisField::RadialBasisField(const DomainChart& chart, std::span<const Vector2d> centres,
                                   std::span<const Vector2d> displacements)
    : chart_(chart) {
  const auto k = static_cast<Eigen::Index>(centres.size());
  for (const Vector2d& centre : centres) centres_.push_back(chart.place(centre));
  Eigen::MatrixXd K(k, k);
  coefficients_.resize(k, 2);
  for (Eigen::Index j = 0; j < k; ++j) {
    const auto c = static_cast<std::size_t>(j);
    for (Eigen::Index i = j; i < k; ++i) {
      K(i, j) = kernel(centres_[static_cast<std::size_t>(i)], centres_[c]);
    }
    coefficients_.row(j) = displacements[c];
  }
  // Pivoting is needed if centres are so close that K is singular up to rounding errors.
  coefficients_ = K.selfadjointView<Eigen::Lower>().ldlt().solve(coefficients_).eval();
}

Vector2d RadialBasisField::at(const Vector2d& point) const {
  const Place z = chart_.place(point);
  if (!(z.clearance > 0.0)) return Vector2d::Zero();
  Vector2d sum = Vector2d::Zero();
  for (std::size_t j = 0; j < centres_.size(); ++j) {
    sum += kernel(z, centres_[j]) * coefficients_.row(static_cast<Eigen::Index>(j)).transpose();
  }
  return sum;
}

}  // namespace lapwing
