#pragma once

#include <Eigen/Core>

#include "lapwing/render/camera.h"

namespace lapwing::viewer {

/// Motions of a camera by the mouse. They keep its field of view and projection, and leave its near
/// and far planes to `fit_depth`. Pixels are from the upper left corner of an image of `size`
/// pixels.

/// Returns the camera's up direction and the direction from its target to its eye.
ViewAxes axes_of(const Camera& camera);

/// Turns the camera around its target after the cursor moved by `pixels`. Sideways motion turns
/// around the world's `upward` direction. Vertical motion turns towards it or away, at most until
/// the camera looks along it. The height of the image corresponds to 180 degrees.
Camera orbited(const Camera& camera, const Eigen::Vector2d& pixels, const Eigen::Vector2d& size,
               const Eigen::Vector3d& upward);

/// Moves the camera sideways so that points at the target's distance follow the cursor.
Camera panned(const Camera& camera, const Eigen::Vector2d& pixels, const Eigen::Vector2d& size);

/// Limits of the distance between eye and target.
struct ZoomRange {
  double nearest = 0.0;
  double farthest = 0.0;
};

/// Enlarges the picture by `factor` around the cursor. The point under it at the target's distance
/// stays there.
Camera zoomed(const Camera& camera, double factor, const Eigen::Vector2d& cursor,
              const Eigen::Vector2d& size, const ZoomRange& range);

/// Returns the camera at the same distance from its target, looking from another side.
Camera looking_from(const Camera& camera, const ViewAxes& axes);

}  // namespace lapwing::viewer
