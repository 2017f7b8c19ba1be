#pragma once

#include <span>
#include <string>
#include <vector>

#include <Eigen/Geometry>

#include "lapwing/mesh/closest_point.h"
#include "lapwing/mesh/topology.h"
#include "lapwing/transplant/loop_curve.h"

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

/// Moves parts that were placed by hand onto a surface. Threads may share an object.
class SurfaceSnap {
 public:
  /// O(n log n) in the triangles. Ignores triangles with a corner that is not finite. Throws
  /// InputError, naming `where`, if no other is left.
  SurfaceSnap(std::span<const Triangle> triangles, std::span<const Eigen::Vector3d> positions,
              const std::string& where);

  /// Returns `placement` followed by the least rigid motion that brings the part's loop onto the
  /// surface. Gauss-Newton steps minimize the sum of the squared distances of points spread evenly
  /// over the loop, as far as they can if the loop does not fit. On a plane this is a move along
  /// its normal and a tilt, without sliding or spinning. Triangles that face against the loop's
  /// normal are avoided if possible, so that a thin sheet is not approached from behind. `part` is
  /// the loop before `placement`, in order with its surface on its left. Throws InputError, naming
  /// `where`, as LoopCurve does.
  Eigen::Affine3d snap(const Eigen::Affine3d& placement, std::span<const Eigen::Vector3d> part,
                       const std::string& where) const;

 private:
  struct Contacts;
  /// `points` are on a loop with that frame.
  Contacts contacts(std::span<const Eigen::Vector3d> points, const LoopFrame& frame) const;

  std::vector<Eigen::Vector3d> normals_;  ///< per triangle, unit length; 0 without area
  ClosestPoint surface_;
};

}  // namespace lapwing
