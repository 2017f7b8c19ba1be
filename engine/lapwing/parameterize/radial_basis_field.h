#pragma once

#include <span>
#include <vector>

#include <Eigen/Core>

#include "lapwing/parameterize/domain_chart.h"

namespace lapwing {

/// A smooth displacement of the domain that takes given values at given centres and vanishes,
/// with its derivatives, along the boundary.
///
/// The kernel is Green's function of the clamped thin plate on the disk (Boggio 1905), carried to
/// other domains by the chart. On a disk the field is therefore the thin-plate spline clamped at
/// the boundary: of all displacements with these values it bends least. With clearances
/// d = 1 - |z|^2 and the ratio s = |z - w|^2 / (d_z d_w) it reads
///   K(z, w) = d_z d_w phi(s),  phi(s) = 1 - s ln(1 + 1/s).
/// It is positive definite, and narrower for a centre near the boundary.
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
