#pragma once

#include <span>
#include <vector>

#include "lapwing/laplacian/weights.h"
#include "lapwing/mesh/topology.h"
#include "lapwing/region/stiffness.h"

namespace lapwing {

/// Parameters of an edit's energy besides the rest shape (ENERGY.md section 3).
struct EnergyTerms {
  LaplacianWeights weights = LaplacianWeights::cotangent;
  /// The detail length l, divided by the region's radius of gyration (the root mean square distance
  /// of its surface from its centroid). Features much smaller than l preserve their shape; shapes
  /// much larger than l bend and stretch elastically. If the value is 0, the energy consists only
  /// of the Laplacian terms, with equal weights as in equation 5.
  double detail_length = 0.0;
  /// Stiffness factors of vertices of the region, ascending; the factor of all other vertices is 1.
  /// They have no effect if the detail length is 0.
  std::vector<VertexStiffness> stiffness = {};

  bool operator==(const EnergyTerms&) const = default;
};

/// The weights of
///     sum_i om_i |L(v'_i) - R_i S_i delta_i|^2 +
///     sum_ij k_ij |v'_i - v'_j - R_i S_i (v_i - v_j)|^2,
/// where j runs over the ring of i. Both sums approximate integrals over the surface: of the
/// squared mean curvature vector, times l^2, and of the squared gradient. The energy therefore
/// depends little on the resolution and regularity of the mesh.
struct EnergyWeights {
  Numbers laplacian;  ///< w_ij of L, per entry of the mesh's rings
  Numbers rows;       ///< om_i, per vertex of the mesh; empty: all 1
  /// k_ij = k_ji, per entry of the mesh's rings; empty: all 0.
  Numbers stiffness;
  /// Stiffness factors, per vertex of the mesh, 0 outside the region; empty: all 1.
  std::vector<double> factors;
};

/// Returns the weights of the region `roi`, which must not be empty. Entries of other vertices are
/// undefined.
///     om_i = mean ring area of the region / max(ring area of i, mean ring area of its neighbours),
///     k_ij = mu c_ij / (2 * 2 sqrt(3)),   mu = A / (n * 2 sqrt(3) * (detail_length r)^2).
/// The region has n vertices, the area A and the radius of gyration r. A / r^2 is at least its
/// value for a strip that is 100 times longer than wide. c_ij is half the value of cotangent_sums,
/// but at least kSmallestCotangentShare / sqrt(3). In a regular triangulation, every c_ij is 1 /
/// sqrt(3), and the six c_ij around a vertex sum to 2 sqrt(3). om_i depends also on the areas of
/// the neighbours, because the large weight of a single tiny ring would fold its triangles.
/// Stiffness factors f multiply om_i by f_i and k_ij by sqrt(f_i f_j); kRigidStiffness counts as
/// 1e4. Takes linear time.
EnergyWeights energy_weights(const Topology& topology, std::span<const Eigen::Vector3d> rest,
                             std::span<const Index> roi, const EnergyTerms& terms);

/// Returns `weights` with the Laplacian weights replaced by those of `scheme`. om and k do not
/// change.
EnergyWeights with_laplacian(EnergyWeights weights, const Topology& topology,
                             std::span<const Eigen::Vector3d> rest, std::span<const Index> roi,
                             LaplacianWeights scheme);

}  // namespace lapwing
