#pragma once

#include <span>
#include <string>
#include <vector>

#include <Eigen/Geometry>

#include "lapwing/closest/closest_point.h"
#include "lapwing/mesh/topology.h"
#include "lapwing/transplant/loop_curve.h"

namespace lapwing {

/// Brings parts that were placed by hand onto a surface. Threads may share one.
class SurfaceSnap {
 public:
  /// O(n log n) in the triangles. Those with a corner that is not finite do not count. Throws
  /// InputError, naming `where`, when there is no other.
  SurfaceSnap(std::span<const Triangle> triangles, std::span<const Eigen::Vector3d> positions,
              const std::string& where);

  /// `placement`, followed by the least rigid motion that makes the sum of the squared distances of
  /// points spread evenly over the part's loop to the surface small: on a plane a move along its
  /// normal and a tilt, without sliding or spinning. What of the surface faces against the way the
  /// part stands is left out where it can be, so that a thin sheet is not taken from behind. A loop
  /// that does not fit the surface comes as near as Gauss-Newton steps find. `part` is the loop
  /// before `placement`, in order with its surface on its left; throws InputError, naming `where`,
  /// as LoopCurve does.
  Eigen::Affine3d snap(const Eigen::Affine3d& placement, std::span<const Eigen::Vector3d> part,
                       const std::string& where) const;

 private:
  struct Contacts;
  /// Of `points`, which are on a loop of that frame.
  Contacts contacts(std::span<const Eigen::Vector3d> points, const LoopFrame& frame) const;

  std::vector<Eigen::Vector3d> normals_;  ///< per triangle, of length 1; 0 without area
  ClosestPoint surface_;
};

}  // namespace lapwing
