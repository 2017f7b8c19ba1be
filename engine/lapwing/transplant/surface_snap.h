#pragma once

#include <span>
#include <string>
#include <vector>

#include <Eigen/Geometry>

#include "lapwing/closest/closest_point.h"
#include "lapwing/mesh/topology.h"
#include "lapwing/transplant/loop_curve.h"

namespace lapwing {

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
