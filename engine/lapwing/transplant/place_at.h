#pragma once

#include <span>
#include <string>

#include <Eigen/Geometry>

namespace lapwing {

/// A place on a surface where a user puts a part.
struct SurfacePlace {
  Eigen::Vector3d point = Eigen::Vector3d::Zero();
  Eigen::Vector3d normal = Eigen::Vector3d::UnitZ();  ///< outward; of any length but 0
  double rotate_degrees = 0.0;  ///< about the normal, on top of `placement`'s; right-handed
  double scale = 1.0;           ///< about the point, on top of `placement`'s; above 0
};

/// Returns `placement`, a similarity, changed so that the part stands on the surface: the centre of
/// its boundary loop is at `place.point`, and the loop's normal (LoopFrame) points along
/// `place.normal`. The rotation is the least one, so that a part that follows a path in small steps
/// does not spin. `part` is the loop before `placement`, in order with its surface on its left.
/// Throws InputError, naming `where`, as LoopCurve does, for a normal of length 0, for numbers that
/// are not finite, and for a scale not above 0.
Eigen::Affine3d place_at(const Eigen::Affine3d& placement, std::span<const Eigen::Vector3d> part,
                         const SurfacePlace& place, const std::string& where);

}  // namespace lapwing
