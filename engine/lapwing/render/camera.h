#pragma once

#include <span>
#include <string>
#include <string_view>

#include <Eigen/Core>

#include "lapwing/mesh/mesh.h"

namespace lapwing {

/// Where a picture is taken from. Plain data; `eye` must differ from `target`.
struct Camera {
  Eigen::Vector3d eye = Eigen::Vector3d::UnitZ();
  Eigen::Vector3d target = Eigen::Vector3d::Zero();
  Eigen::Vector3d up = Eigen::Vector3d::UnitY();
  double field_of_view = 30.0;  ///< vertical, in degrees
  /// Parallel projection. Objects at the target's distance have the same size as in perspective.
  bool orthographic = false;
  /// Horizontal position of the target in the picture, from -1 at the left edge to 1 at the right.
  double target_across = 0.0;
  double near_distance = 0.01;  ///< along the viewing direction; may be negative if orthographic
  double far_distance = 100.0;

  bool operator==(const Camera&) const = default;

  /// From world to camera space: x right, y up, looking along -z. A rotation and a translation.
  Eigen::Matrix4d view() const;
  /// From camera space to Vulkan's clip space: y down, depth 1 at `near_distance` and 0 at
  /// `far_distance` (reversed, so that float depth keeps its digits far away). `aspect` is width /
  /// height.
  Eigen::Matrix4d projection(double aspect) const;
};

/// A half line.
struct Ray {
  Eigen::Vector3d origin = Eigen::Vector3d::Zero();
  Eigen::Vector3d direction = -Eigen::Vector3d::UnitZ();  ///< unit vector
};

/// Returns the ray that starts at the near plane behind `pixel`, which is measured from the upper
/// left corner of a picture of `size` pixels.
Ray line_of_sight(const Camera& camera, const Eigen::Vector2d& pixel, const Eigen::Vector2d& size);

/// The direction from the target to the eye and the up direction. Any length; not parallel.
struct ViewAxes {
  Eigen::Vector3d toward_eye;
  Eigen::Vector3d up;
};

enum class View { three_quarter, front, back, left, right, top, bottom };

/// Which axis of the mesh points up. The front of a mesh faces +z if y is up, and -y if z is.
enum class UpAxis { y, z };

/// Returns unit vectors, perpendicular except for `three_quarter`. `left` looks at the side with
/// small x.
ViewAxes view_axes(View view, UpAxis up_axis = UpAxis::y);

/// Returns the view called `name`: "three-quarter", "front", ... Throws InputError with all names
/// if there is none.
View view_named(std::string_view name);

/// Options of `fit`.
struct Framing {
  double field_of_view = 30.0;  ///< vertical, in degrees
  bool orthographic = false;
  double margin = 0.06;  ///< free fraction of the picture at each side
  double legend = 0.0;   ///< fraction of the width, at the right, that stays free for a legend
};

/// Returns a camera that shows all finite `points` as large as the margin allows, centred beside
/// the legend. Without points, or if all coincide, it shows the unit cube around them. Linear time.
Camera fit(std::span<const Eigen::Vector3d> points, const ViewAxes& axes, double aspect,
           const Framing& framing = {});
Camera fit(const Bounds& bounds, const ViewAxes& axes, double aspect, const Framing& framing = {});

/// Moves the near and far planes so that they just enclose `bounds`. For a camera that a user
/// moves.
void fit_depth(Camera& camera, const Bounds& bounds);

}  // namespace lapwing
