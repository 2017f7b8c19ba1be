#pragma once

#include <span>
#include <string>
#include <string_view>

#include <Eigen/Core>

#include "lapwing/mesh/mesh.h"

namespace lapwing {

/// Position, direction and projection of a view. `eye` must differ from `target`.
struct Camera {
  Eigen::Vector3d eye = Eigen::Vector3d::UnitZ();
  Eigen::Vector3d target = Eigen::Vector3d::Zero();
  Eigen::Vector3d up = Eigen::Vector3d::UnitY();
  double field_of_view = 30.0;  ///< vertical, in degrees
  /// Parallel projection. Objects at the distance of the target have the same size as in
  /// perspective projection.
  bool orthographic = false;
  /// Horizontal position of the target in the image, from -1 at the left edge to 1 at the right.
  double target_across = 0.0;
  double near_distance = 0.01;  ///< along the viewing direction; may be negative if orthographic
  double far_distance = 100.0;

  bool operator==(const Camera&) const = default;

  /// Returns the rigid transform from world to camera space: x right, y up, viewing direction -z.
  Eigen::Matrix4d view() const;
  /// Returns the transform from camera space to Vulkan's clip space: y down, depth 1 at
  /// `near_distance` and 0 at `far_distance` (reversed, for floating-point precision at large
  /// distances). `aspect` is width / height.
  Eigen::Matrix4d projection(double aspect) const;
};

struct Ray {
  Eigen::Vector3d origin = Eigen::Vector3d::Zero();
  Eigen::Vector3d direction = -Eigen::Vector3d::UnitZ();  ///< unit vector
};

/// Returns the viewing ray through `pixel`, starting at the near plane. `pixel` is measured from
/// the upper left corner of an image of `size` pixels.
Ray line_of_sight(const Camera& camera, const Eigen::Vector2d& pixel, const Eigen::Vector2d& size);

/// Directions of a view, of any length and not parallel.
struct ViewAxes {
  Eigen::Vector3d toward_eye;
  Eigen::Vector3d up;
};

enum class View { three_quarter, front, back, left, right, top, bottom };

/// Axis of the mesh that points up. The front of a mesh faces +z if y is up, and -y if z is up.
enum class UpAxis { y, z };

/// Returns unit vectors. They are perpendicular except for `three_quarter`. The view `left` shows
/// the side of the mesh with small x.
ViewAxes view_axes(View view, UpAxis up_axis = UpAxis::y);

/// Returns the view called `name`: "three-quarter", "front", ... If there is none, throws
/// InputError with all valid names.
View view_named(std::string_view name);

struct Framing {
  double field_of_view = 30.0;  ///< vertical, in degrees
  bool orthographic = false;
  double margin = 0.06;  ///< empty fraction of the image at each side
  double legend = 0.0;   ///< fraction of the width, at the right, that is reserved for a legend
};

/// Returns a camera that shows all finite `points` as large as the margin allows, centred in the
/// part of the image beside the legend. If all points coincide, it shows the unit cube around them.
/// Linear time.
Camera fit(std::span<const Eigen::Vector3d> points, const ViewAxes& axes, double aspect,
           const Framing& framing = {});
Camera fit(const Bounds& bounds, const ViewAxes& axes, double aspect, const Framing& framing = {});

/// Moves the near and far planes so that they tightly enclose `bounds`.
void fit_depth(Camera& camera, const Bounds& bounds);

}  // namespace lapwing
