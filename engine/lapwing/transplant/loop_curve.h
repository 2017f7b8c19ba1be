#pragma once

#include <span>
#include <string>
#include <vector>

#include <Eigen/Geometry>

#include "lapwing/region/boundary_loops.h"

namespace lapwing {

/// A closed polyline, parameterized by arc length. Vertices may coincide.
class LoopCurve {
 public:
  /// Throws InputError, naming `where`, for fewer than 3 points, for points that are not finite,
  /// and if all points are on a line, because they do not determine the orientation of a part.
  LoopCurve(std::span<const Eigen::Vector3d> points, const std::string& where);

  double length() const { return lengths_.back(); }
  std::span<const Eigen::Vector3d> points() const {
    return points_;
  }  ///< closed: the last point equals the first

  /// Sets the n entries of `spread` to the points at the fractions `start`, `start` + 1 / n,
  /// `start` + 2 / n, ... of the length. Fractions 0 and 1 are the first vertex.
  void spread(double start, std::span<Eigen::Vector3d> spread) const;

 private:
  std::vector<Eigen::Vector3d> points_;
  std::vector<double> lengths_;  ///< arc length from the first point to each point
};

/// The centre, normal and radius of a loop. They are integrals over its length, so they do not
/// depend on its subdivision.
struct LoopFrame {
  Eigen::Vector3d center;  ///< mean
  /// Unit vector in the direction of the area vector or, if the loop encloses almost no area, of
  /// the smallest extent. The loop is counterclockwise about the normal, so that a part with the
  /// loop as boundary and its surface on the left is on this side.
  Eigen::Vector3d normal;
  double radius = 0.0;  ///< root mean square distance from the centre
};
LoopFrame loop_frame(const LoopCurve& curve);

std::vector<Eigen::Vector3d> loop_points(const BoundaryLoop& loop,
                                         std::span<const Eigen::Vector3d> positions);

double loop_length(const BoundaryLoop& loop, std::span<const Eigen::Vector3d> positions);

std::vector<Eigen::Vector3d> transformed(std::span<const Eigen::Vector3d> points,
                                         const Eigen::Affine3d& map);

}  // namespace lapwing
