#pragma once

#include <vector>

#include "lapwing/coating/patch_coating.h"
#include "lapwing/kernels/kernels.h"
#include "lapwing/laplacian/weights.h"
#include "lapwing/mesh/topology.h"

namespace lapwing {

/// xi, the Laplacians of a coating, at the rows of a target (paper section 5.2), not turned and in
/// the source's units. With d the coating's displacement, p_i where target vertex i lies on the
/// source and w_ij the weights of the target's rings, one_ring gives the Laplacian of d on the ring
/// as it lies there, d being 0 where that leaves the source:
///     xi_i = sum_j w_ij (d(p_i) - d(p_j))
/// Between the source's vertices d is linear, so that all that it is curved lies in the source's
/// edges, and a finer target gets its facets. Linear sampling puts the curvature interpolated
/// between the source's vertices, c, in the place of that:
///     xi_i = sum_j w_ij (d(p_i) - d(p_j)) + r_i^2 / 4 c(p_i) - sum_j w'_ij (d(p_i) - d(p_j))
/// w'_ij and r_i^2 = sum_j w'_ij |p_j - p_i|^2 are weights and squared radius of the ring as it
/// lies on the source's smooth surface: c is a density over that surface, and L of a ring is r^2 /
/// 4 times the Laplace operator. On a ring of the source itself the last two terms cancel: a
/// surface gets its own coating back whatever detail its rings have, which w is of and w' is not.
/// Where a ring leaves the source, c says nothing of the step there, and linear sampling is
/// one_ring.
///
/// `topology` is that of the mesh whose vertices the target's rings name. Linear time.
std::vector<Eigen::Vector3d> sample_coating(const MappedRings& mapped, const Coating& coating,
                                            MappedSampling sampling, const Topology& topology,
                                            LaplacianWeights weights, Kernels& kernels);

}  // namespace lapwing
