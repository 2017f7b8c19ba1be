#pragma once

#include <Eigen/Core>

#include "lapwing/render/camera.h"

namespace lapwing::viewer {

/// How a person moves a camera. All keep the camera's field of view and projection, and none sets
/// its near and far planes (`fit_depth`). Pixels are from the upper left corner of a picture of
/// `size` pixels.

/// Turns the camera around its target after the cursor moved by `pixels`: around the world's
/// `upward` direction for sideways motion, towards or away from it otherwise, up to looking
/// straight along it. The picture's height is half a turn.
Camera orbited(const Camera& camera, const Eigen::Vector2d& pixels, const Eigen::Vector2d& size,
               const Eigen::Vector3d& upward);

/// Moves the camera sideways so that what shows at the target's distance follows the cursor.
Camera panned(const Camera& camera, const Eigen::Vector2d& pixels, const Eigen::Vector2d& size);

/// Distances between eye and target that zooming keeps to.
struct ZoomRange {
  double nearest = 0.0;
  double farthest = 0.0;
};

/// Shows what is around the cursor larger by `factor`: what lies under it at the target's distance
/// stays under it.
Camera zoomed(const Camera& camera, double factor, const Eigen::Vector2d& cursor,
              const Eigen::Vector2d& size, const ZoomRange& range);

/// The camera at the same distance from its target, looking from another side.
Camera looking_from(const Camera& camera, const ViewAxes& axes);

}  // namespace lapwing::viewer
