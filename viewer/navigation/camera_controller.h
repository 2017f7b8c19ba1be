#pragma once

#include <functional>
#include <optional>

#include <Eigen/Core>

#include "lapwing/render/camera.h"
#include "navigation/keymap.h"

namespace lapwing::viewer {

/// What a camera looks at.
struct CameraSubject {
  double diagonal = 1.0;  ///< of its bounds
  /// Returns the surface point at a pixel, if there is one.
  std::function<std::optional<Eigen::Vector3d>(const Eigen::Vector2d& pixel)> pick;
};

/// Moves the camera of a view by mouse events: orbits about the point under the cursor, pans, and
/// zooms towards that point. Pixels start at the upper left corner of the view.
class CameraController {
 public:
  const Camera& camera() const { return camera_; }
  void set_camera(const Camera& camera) { camera_ = camera; }
  UpAxis up_axis() const { return up_axis_; }
  void set_up_axis(UpAxis axis) { up_axis_ = axis; }
  Eigen::Vector3d upward() const;

  /// Sets the size of the view in pixels, and the pixels per point (Projection).
  void resize(const Eigen::Vector2d& size, double pixels_per_point);
  const Eigen::Vector2d& size() const { return size_; }
  double pixels_per_point() const { return pixels_per_point_; }

  /// Handles an event that no tool has taken. Ignores keys.
  void handle(const InputEvent& event, const Keymap& keymap, const CameraSubject& subject);
  /// Starts to orbit about the camera's target, whichever button is down.
  void begin_orbit(const Eigen::Vector2d& pixel);
  /// Returns whether the mouse is moving the camera.
  bool is_moving() const { return motion_.has_value(); }
  /// Where the cursor was last. Set it for events that are not passed to `handle`.
  const Eigen::Vector2d& cursor() const { return cursor_; }
  void set_cursor(const Eigen::Vector2d& pixel) { cursor_ = pixel; }
  /// Returns whether a release at `pixel` ends a click, not a drag.
  bool is_click(const Eigen::Vector2d& pixel) const;

  void look_from(View view);
  void orbit_by(const Eigen::Vector2d& pixels, const Eigen::Vector3d& center);
  void zoom_by(double factor, const Eigen::Vector2d& cursor, double diagonal);

 private:
  Eigen::Vector3d focus(const Eigen::Vector2d& pixel, const CameraSubject& subject);
  void drag_to(const Eigen::Vector2d& pixel, double diagonal);

  Camera camera_;
  UpAxis up_axis_ = UpAxis::y;
  Eigen::Vector2d size_ = Eigen::Vector2d::Ones();
  double pixels_per_point_ = 1.0;
  std::optional<Motion> motion_;  // under way
  Eigen::Vector2d cursor_ = Eigen::Vector2d::Zero();
  Eigen::Vector2d pressed_at_ = Eigen::Vector2d::Zero();
  Eigen::Vector3d orbit_center_ = Eigen::Vector3d::Zero();
};

/// The factor by which a notch of the wheel or a key zooms.
inline constexpr double kZoomPerNotch = 1.15;

}  // namespace lapwing::viewer
