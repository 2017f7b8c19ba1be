#pragma once

#include <span>
#include <string>
#include <string_view>

#include <Eigen/Core>

#include "lapwing/mesh/mesh.h"

namespace lapwing {

/// Where a picture is taken from. Plain data; `eye` differs from `target`.
struct Camera {
  Eigen::Vector3d eye = Eigen::Vector3d::UnitZ();
  Eigen::Vector3d target = Eigen::Vector3d::Zero();
  Eigen::Vector3d up = Eigen::Vector3d::UnitY();
  double field_of_view = 30.0;  ///< vertical, in degrees
  /// Parallel projection that shows what lies at the target's distance as large as the perspective
  /// one does.
  bool orthographic = false;
  /// Where in the picture the target shows, from -1 at its left edge to 1 at its right.
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
  Eigen::Vector3d direction = -Eigen::Vector3d::UnitZ();  ///< of length 1
};

/// What lies behind the place `pixel`, from the upper left corner, of a picture of `size` pixels:
/// the points with depths from the near plane on.
Ray line_of_sight(const Camera& camera, const Eigen::Vector2d& pixel, const Eigen::Vector2d& size);

/// The direction from the target to the eye, and what is up. Any length; not parallel.
struct ViewAxes {
  Eigen::Vector3d toward_eye;
  Eigen::Vector3d up;
};

enum class View { three_quarter, front, back, left, right, top, bottom };

/// Which axis of the mesh points up. The front of a mesh faces +z if y is up, and -y if z is.
enum class UpAxis { y, z };

/// Unit vectors, perpendicular but for `three_quarter`. `left` looks at the side with small x.
ViewAxes view_axes(View view, UpAxis up_axis = UpAxis::y);

/// The view called `name`: "three-quarter", "front", ... Throws InputError that lists them all.
View view_named(std::string_view name);

/// How `fit` frames.
struct Framing {
  double field_of_view = 30.0;  ///< vertical, in degrees
  bool orthographic = false;
  double margin = 0.06;  ///< free part of the picture at each side
  double legend = 0.0;   ///< part of the width, at the right, that stays free for a legend
};

/// A camera that sees all finite `points` as large as the margin allows, centred beside the legend.
/// Linear in their number. Without points, or if all are one, the picture shows the unit cube
/// around it.
Camera fit(std::span<const Eigen::Vector3d> points, const ViewAxes& axes, double aspect,
           const Framing& framing = {});
Camera fit(const Bounds& bounds, const ViewAxes& axes, double aspect, const Framing& framing = {});

/// Moves the near and far planes so that they just hold `bounds`. For a camera that a user moves.
void fit_depth(Camera& camera, const Bounds& bounds);

}  // namespace lapwing
