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
/// carried to other domains by the chart. With clearances d = 1 - |z|^2 and the ratio
/// s = |z - w|^2 / (d_z d_w), a function of the hyperbolic distance, that reads
///   G(z, w) = d_z d_w phi(s),  phi(s) = 1 - s ln(1 + 1/s),
/// and the kernel is phi(s) alone: positive definite, since G is; the same wherever the centre
/// lies, up to a conformal map of the domain onto itself, so narrower near the boundary; falling
/// from 1 at the centre. G itself would move the inside by up to twice what a centre near the
/// boundary is moved by, since a plate bends on beyond it, and folds sooner: its steepest slope for
/// a pull of the disk's middle is 1.47, that of phi 1.13.
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
