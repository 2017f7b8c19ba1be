#pragma once

#include <span>

#include <Eigen/Geometry>

#include "lapwing/mesh/topology.h"
#include "lapwing/region/edit_region.h"
#include "measure.h"

namespace lapwing::bench {

/// CGAL's preparation (weights, assembly, factorization with Eigen) of an as-rigid-as-possible
/// deformation of the same region, held at belt and handles. The mesh must be a manifold.
Samples time_cgal_arap(const Mesh& mesh, const Topology& topology, const EditRegion& region,
                       int repeats);

/// CGAL's variants: of the original paper, and with rotations made smooth (SRE-ARAP).
enum class ArapVariant { original, smooth_rotations };

struct ArapResult {
  Positions positions;
  int iterations = 0;
  Samples frame;  ///< from the rest pose until it converges by its own tolerance
};

/// Deforms with CGAL, belt and handles being where they should exactly: up to `max_iterations`,
/// with its default tolerance (1e-4, by which the energy still changes).
ArapResult deform_by_cgal_arap(const Mesh& mesh, const Topology& topology, const EditRegion& region,
                               std::span<const Eigen::Affine3d> motions, ArapVariant variant,
                               int max_iterations, int repeats);

}  // namespace lapwing::bench
