#pragma once

#include <span>
#include <vector>

#include "lapwing/laplacian/weights.h"
#include "lapwing/mesh/topology.h"

namespace lapwing {

/// What the energy of an edit is made of besides the rest shape (ENERGY.md section 3).
struct EnergyTerms {
  LaplacianWeights weights = LaplacianWeights::cotangent;
  /// l: features much smaller are carried as they are, shapes much larger bend and stretch as
  /// elastic ones. As a share of the region's radius of gyration, the root mean square distance of
  /// its surface from its centroid; 0: Laplacians alone, each row counting the same, as equation 5
  /// has them.
  double detail_length = 0.0;

  bool operator==(const EnergyTerms&) const = default;
};

/// The weights of
///     sum_i om_i |L(v'_i) - R_i S_i delta_i|^2 + sum_ij k_ij |v'_i - v'_j - R_i S_i (v_i -
///     v_j)|^2,
/// j over the ring of i. Both sums approach integrals over the surface, in the ratio l^2 : 1 of
/// squared mean curvature vectors and squared gradients, so that neither a finer mesh nor an uneven
/// one is another surface.
struct EnergyWeights {
  Numbers laplacian;  ///< w_ij of L, per entry of the mesh's rings
  Numbers rows;       ///< om_i, per vertex of the mesh; empty: all 1
  /// k_ij = k_ji, per entry of the mesh's rings; empty: all 0.
  Numbers stiffness;
};

/// For the region `roi`, not empty; entries of other vertices are there and mean nothing.
///     om_i = mean ring area of the region / the larger of that of i and its neighbours' mean;
///     k_ij = mu c_ij / (2 * 2 sqrt(3)),   mu = A / (n * 2 sqrt(3) * (detail_length r)^2),
/// n the vertices of the region, A its area, r its radius of gyration (A / r^2 no less than that of
/// a strip 100 times as long as wide, whose triangles may have no area at all), c_ij half of
/// cotangent_sums made positive (kSmallestCotangentShare of a regular triangulation's 1 / sqrt(3),
/// whose 6 around a vertex sum to 2 sqrt(3)). A ring smaller than those around it counts as one of
/// their size: Laplacians as firm as a single tiny ring would have fold its triangles. Linear time.
EnergyWeights energy_weights(const Topology& topology, std::span<const Eigen::Vector3d> rest,
                             std::span<const Index> roi, const EnergyTerms& terms);

/// The same for other Laplacians alone: om and k are those of the surface.
EnergyWeights with_laplacian(EnergyWeights weights, const Topology& topology,
                             std::span<const Eigen::Vector3d> rest, std::span<const Index> roi,
                             LaplacianWeights scheme);

}  // namespace lapwing
