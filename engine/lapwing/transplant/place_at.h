#pragma once

#include <span>
#include <string>

#include <Eigen/Geometry>

namespace lapwing {

/// Where on a surface a part is put by hand.
struct SurfacePlace {
  Eigen::Vector3d point = Eigen::Vector3d::Zero();
  Eigen::Vector3d normal = Eigen::Vector3d::UnitZ();  ///< outward; of any length but 0
  double rotate_degrees = 0.0;  ///< about the normal, on top of `placement`'s; right-handed
  double scale = 1.0;           ///< about the point, on top of `placement`'s; above 0
};

/// `placement`, a similarity, changed so that the centre of the part's boundary loop comes to
/// `place.point` and the loop's normal (see LoopFrame) points along `place.normal`: the part stands
/// on the surface. By the least rotation, so that a part that follows a path in small steps, each
/// from the last placement, does not spin. `part` is the loop before `placement`, in order with its
/// surface on its left. Throws InputError, naming `where`, for a loop as in LoopCurve, a normal
/// without direction, and a point, turn or scale that is no number or a scale not above 0.
Eigen::Affine3d place_at(const Eigen::Affine3d& placement, std::span<const Eigen::Vector3d> part,
                         const SurfacePlace& place, const std::string& where);

}  // namespace lapwing
