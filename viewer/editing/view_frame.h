#pragma once

#include "lapwing/render/camera.h"
#include "tools/projection.h"

namespace lapwing::viewer {

/// The view of the surface: the camera with fitted near and far planes, and the picture's size and
/// density in pixels.
struct ViewFrame {
  Camera camera;
  Eigen::Vector2d size = Eigen::Vector2d::Ones();
  double pixels_per_point = 1.0;

  Projection projection() const {
    return {camera.projection(size.x() / size.y()) * camera.view(), size, pixels_per_point};
  }

  bool operator==(const ViewFrame&) const = default;
};

}  // namespace lapwing::viewer
