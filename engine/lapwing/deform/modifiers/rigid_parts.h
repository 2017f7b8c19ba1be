#pragma once

#include <optional>
#include <span>

#include "lapwing/deform/handle_motion.h"
#include "lapwing/mesh/topology.h"
#include "lapwing/region/edit_region.h"

namespace lapwing {

/// Returns the edit for the second minimization (ENERGY.md section 3), in which rigid parts are
/// handles. A rigid part is a connected set of vertices with the factor kRigidStiffness. Each part
/// becomes an additional handle. If a handle or the belt already holds some of its vertices, all
/// its vertices join that handle or the belt. A part that contains targets, or vertices of several
/// handles, does not become a handle. It keeps its factor, so it is only nearly rigid. Returns
/// nothing if no part changes.
std::optional<EditRegion> with_rigid_handles(EditRegion region, const Topology& topology,
                                             std::optional<double> constraint_weight);

/// For each additional handle of `rigid`, adds to `motions` the rigid motion that is nearest to the
/// `displacement` of the handle's vertices. The result has no handles with free orientation.
HandleMotions with_rigid_motions(const HandleMotions& motions, const EditRegion& rigid,
                                 std::span<const Eigen::Vector3d> rest,
                                 std::span<const Eigen::Vector3d> displacement);

}  // namespace lapwing
