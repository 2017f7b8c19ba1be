#pragma once

#include <span>
#include <vector>

#include "lapwing/kernels/kernels.h"
#include "lapwing/laplacian/weights.h"
#include "lapwing/mesh/topology.h"
#include "lapwing/patch/patch.h"

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

}  // namespace lapwing
