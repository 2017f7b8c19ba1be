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
  /// Throws InputError, naming `where`, for fewer than 3 points, a point that is not finite, and
  /// points on a line, which do not determine how a part stands.
  LoopCurve(std::span<const Eigen::Vector3d> points, const std::string& where);

  double length() const { return lengths_.back(); }
  std::span<const Eigen::Vector3d> points() const {
    return points_;
  }  ///< the first point again at the end

  /// Sets the n entries of `spread` to the points at the shares `start`, `start` + 1 / n, `start` +
  /// 2 / n, ... of the way around. Shares 0 and 1 are the first vertex.
  void spread(double start, std::span<Eigen::Vector3d> spread) const;

 private:
  std::vector<Eigen::Vector3d> points_;
  std::vector<double> lengths_;  ///< from the first point to each
};

/// The centre, normal and radius of a loop. They are integrals over its length, so that it does not
/// matter how finely it is divided.
struct LoopFrame {
  Eigen::Vector3d center;  ///< mean
  /// Unit vector, the direction of the area vector, or of the least width if the loop encloses no
  /// area. Seen from its tip the loop runs counter-clockwise, so that a part with this boundary,
  /// its surface on the left, stands on that side.
  Eigen::Vector3d normal;
  double radius = 0.0;  ///< root mean square distance from the centre
};
LoopFrame loop_frame(const LoopCurve& curve);

/// Returns the positions of a loop's vertices.
std::vector<Eigen::Vector3d> loop_points(const BoundaryLoop& loop,
                                         std::span<const Eigen::Vector3d> positions);

double loop_length(const BoundaryLoop& loop, std::span<const Eigen::Vector3d> positions);

/// Returns `map` applied to each of `points`.
std::vector<Eigen::Vector3d> transformed(std::span<const Eigen::Vector3d> points,
                                         const Eigen::Affine3d& map);

}  // namespace lapwing
