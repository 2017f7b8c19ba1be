#pragma once

#include <span>
#include <string>
#include <vector>

#include <Eigen/Geometry>

#include "lapwing/region/boundary_loops.h"

namespace lapwing {

/// A closed polyline, by arc length. Vertices may coincide.
class LoopCurve {
 public:
  /// Throws InputError, naming `where`, for fewer than 3 points, one that is not finite, and points
  /// on a line, which say nothing about how a part stands.
  LoopCurve(std::span<const Eigen::Vector3d> points, const std::string& where);

  double length() const { return lengths_.back(); }
  std::span<const Eigen::Vector3d> points() const {
    return points_;
  }  ///< the first again at the end

  /// Where `start`, `start` + 1 / n, `start` + 2 / n, ... of the way around are; 0 is the first
  /// vertex, and so is 1. One point per entry of `spread`.
  void spread(double start, std::span<Eigen::Vector3d> spread) const;

 private:
  std::vector<Eigen::Vector3d> points_;
  std::vector<double> lengths_;  ///< from the first point to each
};

/// How a loop lies in space, by its length, so that it does not matter how finely a part of it is
/// divided.
struct LoopFrame {
  Eigen::Vector3d center;  ///< mean
  /// Of length 1. Seen from where it points to the loop runs counter-clockwise (by the area vector;
  /// for a loop that encloses none, where it is least wide): a part with the loop as its boundary,
  /// the surface on the left, stands on that side.
  Eigen::Vector3d normal;
  double radius = 0.0;  ///< root mean square distance from the centre
};
LoopFrame loop_frame(const LoopCurve& curve);

/// The positions along a boundary loop.
std::vector<Eigen::Vector3d> loop_points(const BoundaryLoop& loop,
                                         std::span<const Eigen::Vector3d> positions);

/// The length of a boundary loop.
double loop_length(const BoundaryLoop& loop, std::span<const Eigen::Vector3d> positions);

/// The images of `points`.
std::vector<Eigen::Vector3d> transformed(std::span<const Eigen::Vector3d> points,
                                         const Eigen::Affine3d& map);

}  // namespace lapwing
