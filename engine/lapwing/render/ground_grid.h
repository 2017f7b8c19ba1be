#pragma once

#include <Eigen/Core>

#include "lapwing/mesh/mesh.h"
#include "lapwing/render/camera.h"

namespace lapwing {

/// A square grid on the ground under a mesh. Its lines are at multiples of `spacing` in world
/// coordinates, and the two axes on the ground are coloured. The grid fades out towards its rim.
struct GroundGrid {
  UpAxis up = UpAxis::y;
  double spacing = 1.0;
  Eigen::Vector3d center = Eigen::Vector3d::Zero();  ///< a crossing of two lines
  double radius = 10.0;                              ///< distance from the centre to the rim

  bool operator==(const GroundGrid&) const = default;

  /// Returns the box that contains the grid.
  Bounds bounds() const;
};

/// Returns a grid just below the lowest point of `bounds`, around its centre. The spacing is the
/// largest of ..., 1, 2, 5, 10, 20, 50, ... that is at most a tenth of the diagonal. If all points
/// coincide, the diagonal counts as 1.
GroundGrid ground_grid(const Bounds& bounds, UpAxis up);

}  // namespace lapwing
