#pragma once

#include <span>
#include <vector>

#include "lapwing/kernels/kernels.h"
#include "lapwing/laplacian/weights.h"
#include "lapwing/mesh/topology.h"
#include "lapwing/patch/patch.h"

namespace lapwing {

/// The coating of a patch (paper section 5.1): what the surface S has over its smooth version, in
/// the patch's own numbers.
struct Coating {
  Patch patch;
  std::vector<Eigen::Vector3d> positions;     ///< of S
  std::vector<Eigen::Vector3d> smooth;        ///< of S smooth
  std::vector<Eigen::Vector3d> normals;       ///< of S smooth, unit length
  std::vector<Eigen::Vector3d> displacement;  ///< S - S smooth; its Laplacian is xi
  /// xi as a density: what the Laplace operator gives of `displacement`, xi_i times 4 / (the
  /// squared radius of ring i). Does not hang on how finely the patch is triangulated.
  std::vector<Eigen::Vector3d> curvature;
};

/// Peels `patch`. Smoothing works on the patch grown by `detail_size`, where the mesh goes on, so
/// that its held border leaves the patch alone. Throws InputError for a size not above 0.
Coating peel_patch(Patch patch, std::span<const Eigen::Vector3d> positions,
                   const Topology& topology, double detail_size, LaplacianWeights weights,
                   Kernels& kernels);

/// The whole shape of `patch` as a coating: `displacement` is where its vertices are (from their
/// mean), so that xi is delta itself, and the frames are those of the surface below features of
/// `frame_size`. For mixing (section 5.3), where a target's shape is replaced; see
/// CoatTarget::whole.
Coating whole_shape(Patch patch, std::span<const Eigen::Vector3d> positions,
                    const Topology& topology, double frame_size, LaplacianWeights weights,
                    Kernels& kernels);

}  // namespace lapwing
