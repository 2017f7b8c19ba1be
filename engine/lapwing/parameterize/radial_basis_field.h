#pragma once

#include <span>
#include <vector>

#include <Eigen/Core>

#include "lapwing/parameterize/domain_chart.h"

namespace lapwing {

/// A smooth displacement field on the domain that interpolates given displacements at given centres
/// and is zero on the boundary.
///
/// The kernel is derived from Green's function of the clamped thin plate on the disk (Boggio 1905);
/// a DomainChart transfers it to other domains. Let d = 1 - |z|^2 be the clearance of a point, and
/// s = |z - w|^2 / (d_z d_w), a function of the hyperbolic distance. Green's function is
///     G(z, w) = d_z d_w phi(s),  phi(s) = 1 - s ln(1 + 1/s),
/// and the kernel is phi(s) alone. It is positive definite because G is, and decreases from 1 at
/// the centre. The kernels of all centres are equal up to a conformal map of the domain onto
/// itself, so a kernel near the boundary is narrower. With G, a pull near the boundary would
/// displace inner points up to twice as far as the pulled point, and the map would fold earlier:
/// for a pull of the disk's centre, the steepest slope is 1.47 for G and 1.13 for phi.
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
