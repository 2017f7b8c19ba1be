#pragma once

#include <optional>
#include <span>

#include <Eigen/Core>

#include "lapwing/mesh/topology.h"

namespace lapwing::viewer {

/// What shows at one pixel: a half line; `direction` has length 1.
struct SightLine {
  Eigen::Vector3d origin;
  Eigen::Vector3d direction;
};

/// How the window shows space, in pixels from its upper left corner. `Camera::projection(aspect) *
/// Camera::view()` gives the matrix: y down, depth 1 near and 0 far.
///
/// What is sized for the hand and the eye (how near a click must be, how thick a line is) is given
/// in points: a pixel of a desktop that enlarges nothing, 1/96 inch or so, and as many pixels on a
/// dense display as its scale says. Names of such lengths end in `Pt` or `_pt`.
class Projection {
 public:
  Projection(const Eigen::Matrix4d& clip_from_world, const Eigen::Vector2d& size_in_pixels,
             double pixels_per_point = 1.0);

  /// Where `point` shows, inside the window or not; nothing behind the eye.
  std::optional<Eigen::Vector2d> to_pixel(const Eigen::Vector3d& point) const;
  /// What shows at a pixel, from the near plane on.
  SightLine ray_through(const Eigen::Vector2d& pixel) const;
  /// From `point` to the eye; length 1.
  Eigen::Vector3d toward_eye(const Eigen::Vector3d& point) const;
  /// The length, across the view at `point`, that one pixel shows.
  double length_of_pixel(const Eigen::Vector3d& point) const;
  double in_pixels(double length_pt) const { return pixels_per_point_ * length_pt; }

 private:
  Eigen::Matrix4d clip_from_world_;
  Eigen::Matrix4d world_from_clip_;
  Eigen::Vector2d size_;
  double pixels_per_point_;
};

/// A place on the surface.
struct SurfacePoint {
  Index triangle = kNoIndex;
  Index vertex = kNoIndex;  ///< the triangle's corner nearest to `position`
  Eigen::Vector3d position = Eigen::Vector3d::Zero();
};

/// Where `ray` first meets the surface, from either side. Linear in its triangles; a window asks
/// its picture instead where it can.
std::optional<SurfacePoint> pick_surface(const Topology& topology,
                                         std::span<const Eigen::Vector3d> positions,
                                         const SightLine& ray);

/// The same of the triangles without a corner that `left_out` marks, one entry per vertex.
std::optional<SurfacePoint> pick_beside(const Topology& topology,
                                        std::span<const Eigen::Vector3d> positions,
                                        std::span<const char> left_out, const SightLine& ray);

/// Where `ray` meets that triangle; nothing where it passes by.
std::optional<SurfacePoint> pick_triangle(const Topology& topology,
                                          std::span<const Eigen::Vector3d> positions,
                                          Index triangle, const SightLine& ray);

/// The place `position` on `triangle`.
SurfacePoint surface_point(const Topology& topology, std::span<const Eigen::Vector3d> positions,
                           Index triangle, const Eigen::Vector3d& position);

}  // namespace lapwing::viewer
