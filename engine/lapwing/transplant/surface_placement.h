#pragma once

#include <span>
#include <string>
#include <vector>

#include <Eigen/Geometry>

#include "lapwing/mesh/closest_point.h"
#include "lapwing/mesh/topology.h"
#include "lapwing/transplant/loop_curve.h"

namespace lapwing {

/// A user-defined position of a part on a surface.
struct SurfacePlace {
  Eigen::Vector3d point = Eigen::Vector3d::Zero();
  Eigen::Vector3d normal = Eigen::Vector3d::UnitZ();  ///< outward; any positive length
  double rotate_degrees = 0.0;  ///< about the normal, in addition to `placement`; right-handed
  double scale = 1.0;           ///< about the point, in addition to `placement`; positive
};

/// Returns `placement`, a similarity transform, changed so that the centre of the part's boundary
/// loop is at `place.point` and the loop's normal (LoopFrame) has the direction of `place.normal`.
/// The change uses the smallest possible rotation, so that a part that follows a path in small
/// steps does not spin. `part` is the loop before `placement`, in order, with its surface on the
/// left. Throws InputError, naming `where`, as LoopCurve does, and if the normal has length 0, a
/// number is not finite, or the scale is not positive.
Eigen::Affine3d place_at(const Eigen::Affine3d& placement, std::span<const Eigen::Vector3d> part,
                         const SurfacePlace& place, const std::string& where);

/// Moves parts that were placed by hand onto a surface. Thread-safe.
class SurfaceSnap {
 public:
  /// O(n log n) for n triangles. Ignores triangles with a corner that is not finite. Throws
  /// InputError, naming `where`, if no finite triangle is left.
  SurfaceSnap(std::span<const Triangle> triangles, std::span<const Eigen::Vector3d> positions,
              const std::string& where);

  /// Returns `placement` followed by a small rigid motion of the part's loop onto the surface.
  /// Gauss-Newton steps minimize the sum of squared distances from the surface over evenly spaced
  /// points of the loop. On a plane, the motion is a translation along the normal and a tilt,
  /// without sliding or spinning. Avoids triangles that face opposite to the loop's normal, so that
  /// the loop does not snap to the back of a thin sheet. `part` is the loop before `placement`, in
  /// order, with its surface on the left. Throws InputError, naming `where`, as LoopCurve does.
  Eigen::Affine3d snap(const Eigen::Affine3d& placement, std::span<const Eigen::Vector3d> part,
                       const std::string& where) const;

 private:
  struct Contacts;
  /// `points` are on a loop with the frame `frame`.
  Contacts contacts(std::span<const Eigen::Vector3d> points, const LoopFrame& frame) const;

  std::vector<Eigen::Vector3d> normals_;  ///< per triangle, unit length; zero if degenerate
  ClosestPoint surface_;
};

}  // namespace lapwing
