#pragma once

#include <span>
#include <vector>

#include "lapwing/kernels/kernels.h"
#include "lapwing/laplacian/weights.h"
#include "lapwing/mesh/topology.h"
#include "lapwing/parameterize/patch.h"

namespace lapwing {

/// The coating of a patch (paper section 5.1): the difference between the surface S and its smooth
/// version, by local index of the patch.
struct Coating {
  Patch patch;
  std::vector<Eigen::Vector3d> positions;     ///< of S
  std::vector<Eigen::Vector3d> smooth;        ///< of S smooth
  std::vector<Eigen::Vector3d> normals;       ///< of S smooth, unit length
  std::vector<Eigen::Vector3d> displacement;  ///< S - S smooth; its Laplacian is xi
  /// The Laplace operator of `displacement`, that is, xi_i times 4 / (squared radius of ring i).
  /// Unlike xi, it does not depend on the edge lengths of the patch.
  std::vector<Eigen::Vector3d> curvature;
};

/// Peels `patch`. Smooths the patch and its surroundings within `detail_size`, so that the fixed
/// border is away from the patch. Throws InputError unless `detail_size` is positive.
Coating peel_patch(Patch patch, std::span<const Eigen::Vector3d> positions,
                   const Topology& topology, double detail_size, LaplacianWeights weights,
                   Kernels& kernels);

/// Returns the whole shape of `patch` as a coating: `displacement` is the offset of the vertices
/// from their mean, so that xi equals delta. The frames are those of the surface without features
/// below `frame_size`. For mixes that replace the target's shape (section 5.3); see
/// CoatTarget::whole.
Coating whole_shape(Patch patch, std::span<const Eigen::Vector3d> positions,
                    const Topology& topology, double frame_size, LaplacianWeights weights,
                    Kernels& kernels);

/// Returns xi, the Laplacians of a coating at the rows of a target (paper section 5.2), not rotated
/// and in the source's units. Let d be the coating's displacement, p_i the point of target vertex i
/// on the source, and w_ij the weights of the target's rings. one_ring sampling returns the
/// Laplacian of d on the ring as mapped to the source, with d = 0 outside the source:
///     xi_i = sum_j w_ij (d(p_i) - d(p_j))
/// d is piecewise linear on the source's triangles, so its curvature is concentrated at the
/// source's edges, and a finer target shows the facets of the source. Linear sampling replaces this
/// curvature by c, Coating::curvature interpolated linearly:
///     xi_i = sum_j w_ij (d(p_i) - d(p_j)) + r_i^2 / 4 c(p_i) - sum_j w'_ij (d(p_i) - d(p_j))
/// w'_ij and r_i^2 = sum_j w'_ij |p_j - p_i|^2 are the weights and the squared radius of the ring
/// as mapped to the source's smooth surface; L of a ring is r^2 / 4 times the Laplace operator. On
/// a ring of the source itself, the last two terms cancel, so coating a surface with its own
/// coating reproduces it, although its detail enters w but not w'. If a ring leaves the source, c
/// lacks the step of d to 0, so one_ring sampling is used.
///
/// `topology` is the topology of the target's mesh. Linear time.
std::vector<Eigen::Vector3d> sample_coating(const MappedRings& mapped, const Coating& coating,
                                            MappedSampling sampling, const Topology& topology,
                                            LaplacianWeights weights, Kernels& kernels);

}  // namespace lapwing
