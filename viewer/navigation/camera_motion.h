#pragma once

#include <Eigen/Core>

#include "lapwing/render/camera.h"

namespace lapwing::viewer {

/// Functions that move a camera by the mouse. They do not change its field of view and projection.
/// The caller sets the near and far planes by `fit_depth`. The origin of pixel coordinates is the
/// upper left corner of an image of `size` pixels.

/// Returns the camera's up direction and the direction from its target to its eye.
ViewAxes axes_of(const Camera& camera);

/// Moves the target along the line of sight to the depth of `point`, which must be in front of the
/// camera. The image stays the same. Then `panned` and `zoomed` follow the surface there.
Camera focused(const Camera& camera, const Eigen::Vector3d& point);

/// Rotates the camera about `center` after the cursor moved by `pixels`; `center` keeps its
/// position in the image. Horizontal motion rotates about the world's up direction `upward`.
/// Vertical motion changes the angle between the line of sight and `upward`, from 0 to 180 degrees.
/// The height of the image corresponds to 180 degrees.
Camera orbited(const Camera& camera, const Eigen::Vector2d& pixels, const Eigen::Vector2d& size,
               const Eigen::Vector3d& upward, const Eigen::Vector3d& center);

/// Moves the camera parallel to the image plane so that points at the target's depth follow the
/// cursor.
Camera panned(const Camera& camera, const Eigen::Vector2d& pixels, const Eigen::Vector2d& size);

/// Limits of the distance between eye and target.
struct ZoomRange {
  double nearest = 0.0;
  double farthest = 0.0;
};

/// Returns the limits for a mesh whose bounds have this diagonal. The eye stays at least a
/// thousandth of the diagonal in front of the point to which it zooms.
ZoomRange zoom_range(double diagonal);

/// Enlarges the image by `factor`. The point under the cursor at the target's depth stays under the
/// cursor. Outside `range`, the distance only changes towards it.
Camera zoomed(const Camera& camera, double factor, const Eigen::Vector2d& cursor,
              const Eigen::Vector2d& size, const ZoomRange& range);

/// Returns the camera with the view direction `axes`, at the same distance from the same target.
Camera looking_from(const Camera& camera, const ViewAxes& axes);

}  // namespace lapwing::viewer
