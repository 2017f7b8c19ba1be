#pragma once

#include <optional>
#include <span>

#include <Eigen/Core>

#include "lapwing/mesh/topology.h"

namespace lapwing::viewer {

/// The ray of points that show at one pixel; `direction` has length 1.
struct Ray {
  Eigen::Vector3d origin;
  Eigen::Vector3d direction;
};

/// Maps between space and the window, in pixels from its upper left corner.
/// `Camera::projection(aspect) * Camera::view()` gives the matrix: y down, depth 1 near and 0 far.
///
/// Sizes on the screen, such as the pick radius of a click, are in points. Their names end in `Pt`
/// or `_pt`. One point is one pixel if the desktop's scale factor is 1.
class Projection {
 public:
  Projection(const Eigen::Matrix4d& clip_from_world, const Eigen::Vector2d& size_in_pixels,
             double pixels_per_point = 1.0);

  /// Returns the pixel of `point`, inside the window or not; nullopt if it is behind the eye.
  std::optional<Eigen::Vector2d> to_pixel(const Eigen::Vector3d& point) const;
  /// Returns the ray through a pixel, from the near plane on.
  Ray ray_through(const Eigen::Vector2d& pixel) const;
  /// Returns the unit vector from `point` to the eye.
  Eigen::Vector3d toward_eye(const Eigen::Vector3d& point) const;
  /// Returns the length of one pixel across the view at `point`; 0 if it is behind the eye.
  double length_of_pixel(const Eigen::Vector3d& point) const;
  double in_pixels(double length_pt) const { return pixels_per_point_ * length_pt; }

 private:
  Eigen::Matrix4d clip_from_world_;
  Eigen::Matrix4d world_from_clip_;
  Eigen::Vector2d size_;
  double pixels_per_point_;
};

/// A point on the surface.
struct SurfacePoint {
  Index triangle = kNoIndex;
  Index vertex = kNoIndex;  ///< the triangle's corner nearest to `position`
  Eigen::Vector3d position = Eigen::Vector3d::Zero();
};

/// Returns the first point where `ray` meets the surface, from either side. Linear in its
/// triangles.
std::optional<SurfacePoint> pick_surface(const Topology& topology,
                                         std::span<const Eigen::Vector3d> positions,
                                         const Ray& ray);

/// The same without the triangles that have a corner marked in `left_out`, one entry per vertex.
std::optional<SurfacePoint> pick_beside(const Topology& topology,
                                        std::span<const Eigen::Vector3d> positions,
                                        std::span<const char> left_out, const Ray& ray);

/// Returns the point where `ray` meets `triangle`; nullopt if it misses.
std::optional<SurfacePoint> pick_triangle(const Topology& topology,
                                          std::span<const Eigen::Vector3d> positions,
                                          Index triangle, const Ray& ray);

/// Returns `position` on `triangle` with the nearest corner.
SurfacePoint surface_point(const Topology& topology, std::span<const Eigen::Vector3d> positions,
                           Index triangle, const Eigen::Vector3d& position);

}  // namespace lapwing::viewer
