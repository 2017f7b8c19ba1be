#pragma once

#include <optional>
#include <span>
#include <vector>

#include "lapwing/laplacian/normal_matrix.h"
#include "lapwing/laplacian/springs.h"
#include "lapwing/mesh/topology.h"
#include "lapwing/region/edit_region.h"

namespace lapwing {

/// The unknowns of an edit and their constraint stiffness.
struct Constraints {
  Unknowns unknowns;
  /// Stiffness of each unknown: kStiff or the squared weight on belt and handles, less in a
  /// handle's falloff, and 0 elsewhere.
  std::vector<double> W;
};

/// Returns the constraints of a region. `weight` is DeformOptions::constraint_weight. If it is
/// empty, the stiffness is kStiff for the belt and for handles without their own weight. With soft
/// constraints, all vertices of the region are unknowns, except those with hard targets. With hard
/// constraints, only free vertices are unknowns. The displacements of all other vertices are
/// prescribed. Soft targets and targets inside triangles are springs. Belt and handles do not
/// constrain the corners of a hard target. Unconstrained vertices without a ring do not move and
/// are not unknowns.
Constraints constraints_of(const EditRegion& region, const Topology& topology,
                           std::optional<double> weight, bool hard);

/// Returns one vector per vertex of the mesh: `prescribed` at the vertices of `roi` that are not
/// unknowns, and 0 elsewhere. Right-hand sides must account for these values. To save memory,
/// returns an empty vector if all are 0, as with soft constraints.
std::vector<Eigen::Vector3d> dirichlet_values(std::span<const Index> roi, const Unknowns& unknowns,
                                              std::span<const Eigen::Vector3d> prescribed);

}  // namespace lapwing
