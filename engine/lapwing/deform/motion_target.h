#pragma once

#include <span>
#include <vector>

#include "lapwing/deform/edit_system.h"
#include "lapwing/deform/handle_motion.h"
#include "lapwing/deform/handle_weights.h"
#include "lapwing/deform/rest_stretch.h"
#include "lapwing/elastic/energy_minimizer.h"

namespace lapwing {

/// The constraints on a surface for given motions of its handles.
struct MotionTarget {
  HandleMotions motions;
  std::vector<double> parameters;  ///< of `motions` (EditSystem::set_parameters)
  RestStretch stretch;
  std::vector<FreeHandle> free_handles;
  std::vector<Eigen::Vector3d> prescribed;  ///< displacements, per vertex of the mesh

  MinimizerTarget settle_target() const {
    return {prescribed, stretch.of_vertices, {}, free_handles};
  }
};

/// Returns the target for `motions`. `prescribed` is empty, or comes from an earlier target of the
/// same edit. Its memory is then reused, and the cost is linear in the number of handle vertices.
/// Throws InputError if the number of motions differs from the number of handles or a motion is too
/// large. Also throws InputError if a handle is free and the edit does not settle with soft
/// constraints.
MotionTarget motion_target(const EditSystem& edit, HandleMotions motions,
                           std::vector<Eigen::Vector3d> prescribed = {});

/// Replaces the rotations of the free handles of `target` by `rotations`, one per free handle.
void set_free_rotations(const EditSystem& edit, std::span<const Eigen::Matrix3d> rotations,
                        MotionTarget& target);

/// Returns `motions` with the rotations of free handles replaced by those in `pose`.
HandleMotions turned_as(HandleMotions motions, const HandleMotions& pose, const EditSystem& edit);

/// Returns true if a handle has turned by more than kFarTurnDegrees, which linear responses cannot
/// represent.
bool any_turned_far(std::span<const Eigen::AngleAxisd> turns);
/// Like `any_turned_far`, for the turns between `last` and `now`. Ignores free handles.
bool any_turned_far_since(const HandleMotions& last, const HandleMotions& now);

/// Returns the start of a minimization without a pose: the displacement of every vertex by the
/// handle weights and the edit's targets.
std::vector<Eigen::Vector3d> start_by_handle_weights(const EditSystem& edit,
                                                     const HandleWeights& weights,
                                                     const MotionTarget& target);

/// Sets the displacements of the constrained vertices in `u`. For belt vertices, this is their
/// displacement in `last`; for handle vertices, it is `last` + `prescribed` - `last_prescribed`.
void move_held(const EditSystem& edit, std::span<const Eigen::Vector3d> last_prescribed,
               std::span<const Eigen::Vector3d> prescribed, std::span<const Eigen::Vector3d> last,
               std::span<Eigen::Vector3d> u);

}  // namespace lapwing
