#pragma once

#include <span>
#include <vector>

#include <Eigen/Core>

#include "lapwing/parameterize/domain_chart.h"

namespace lapwing {

/// A smooth displacement of the domain that takes given values at given centres and vanishes on the
/// boundary.
///
/// The kernel comes from Green's function of the clamped thin plate on the disk (Boggio 1905),
/// which the chart carries to other domains. With clearances d = 1 - |z|^2 and the ratio
/// s = |z - w|^2 / (d_z d_w), a function of the hyperbolic distance, Green's function is
///     G(z, w) = d_z d_w phi(s),  phi(s) = 1 - s ln(1 + 1/s),
/// and the kernel is phi(s) alone. It is positive definite, since G is, and falls from 1 at the
/// centre. Up to a conformal map of the domain onto itself it is the same for every centre, so it
/// is narrower near the boundary. G itself would move the inside up to twice as far as a centre
/// near the boundary, since a plate bends on beyond it, and would fold sooner: its steepest slope
/// for a pull of the disk's middle is 1.47, that of phi 1.13.
class RadialBasisField {
 public:
  /// O(k^3) for k centres, all inside the domain.
  RadialBasisField(const DomainChart& chart, std::span<const Eigen::Vector2d> centres,
                   std::span<const Eigen::Vector2d> displacements);

  /// O(k). Zero on the boundary.
  Eigen::Vector2d at(const Eigen::Vector2d& point) const;

 private:
  const DomainChart& chart_;
  std::vector<DomainChart::Place> centres_;
  Eigen::MatrixX2d coefficients_;
};

}  // namespace lapwing
