#pragma once

#include <span>
#include <vector>

#include "lapwing/kernels/kernels.h"
#include "lapwing/laplacian/weights.h"
#include "lapwing/mesh/topology.h"
#include "lapwing/parameterize/patch.h"

namespace lapwing {

/// The coating of a patch (paper section 5.1): the detail of the surface S over its smooth version,
/// in own numbers of the patch.
struct Coating {
  Patch patch;
  std::vector<Eigen::Vector3d> positions;     ///< of S
  std::vector<Eigen::Vector3d> smooth;        ///< of S smooth
  std::vector<Eigen::Vector3d> normals;       ///< of S smooth, unit length
  std::vector<Eigen::Vector3d> displacement;  ///< S - S smooth; its Laplacian is xi
  /// xi as a density, the Laplace operator of `displacement`: xi_i times 4 / (the squared radius of
  /// ring i). It does not depend on how finely the patch is triangulated.
  std::vector<Eigen::Vector3d> curvature;
};

/// Peels `patch`. Smooths the patch grown by `detail_size`, if the mesh goes on there, so that the
/// held border does not touch the patch. Throws InputError if `detail_size` is not above 0.
Coating peel_patch(Patch patch, std::span<const Eigen::Vector3d> positions,
                   const Topology& topology, double detail_size, LaplacianWeights weights,
                   Kernels& kernels);

/// Returns the whole shape of `patch` as a coating: `displacement` is the offset of its vertices
/// from their mean, so that xi is delta itself. The frames are those of the surface without
/// features below `frame_size`. For mixes that replace a target's shape (section 5.3); see
/// CoatTarget::whole.
Coating whole_shape(Patch patch, std::span<const Eigen::Vector3d> positions,
                    const Topology& topology, double frame_size, LaplacianWeights weights,
                    Kernels& kernels);

/// Returns xi, the Laplacians of a coating, at the rows of a target (paper section 5.2), not
/// rotated and in the source's units. d is the coating's displacement, p_i the point of target
/// vertex i on the source, and w_ij are the weights of the target's rings. one_ring gives the
/// Laplacian of d on the ring as it lies on the source, with d = 0 off the source:
///     xi_i = sum_j w_ij (d(p_i) - d(p_j))
/// d is linear between the source's vertices. All its curvature lies in the source's edges, so a
/// finer target shows the source's facets. Linear sampling replaces this by c, the curvature
/// interpolated between the source's vertices:
///     xi_i = sum_j w_ij (d(p_i) - d(p_j)) + r_i^2 / 4 c(p_i) - sum_j w'_ij (d(p_i) - d(p_j))
/// w'_ij and r_i^2 = sum_j w'_ij |p_j - p_i|^2 are weights and squared radius of the ring as it
/// lies on the source's smooth surface. c is a density over that surface, and L of a ring is
/// r^2 / 4 times the Laplace operator. On a ring of the source itself the last two terms cancel. So
/// a surface gets its own coating back, whatever detail its rings have, which enters w but not w'.
/// If a ring leaves the source, c does not contain the step there, and linear sampling is one_ring.
///
/// `topology` is that of the mesh to which the target's vertex numbers refer. Linear time.
std::vector<Eigen::Vector3d> sample_coating(const MappedRings& mapped, const Coating& coating,
                                            MappedSampling sampling, const Topology& topology,
                                            LaplacianWeights weights, Kernels& kernels);

}  // namespace lapwing
