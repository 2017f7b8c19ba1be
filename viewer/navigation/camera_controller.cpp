#include "navigation/camera_controller.h"

#include <cmath>

#include "navigation/camera_motion.h"

namespace lapwing::viewer {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

// A press and release within this many points is a click, not a drag.
constexpr double kClickPt = 3.0;
// A zooming drag of this many points magnifies the view by the factor e.
constexpr double kZoomPt = 150.0;

}  // namespace

void CameraController::resize(const Vector2d& size, double pixels_per_point) {
  size_ = size;
  pixels_per_point_ = pixels_per_point;
}

Vector3d CameraController::upward() const {
  return up_axis_ == UpAxis::y ? Vector3d::UnitY() : Vector3d::UnitZ();
}

bool CameraController::is_click(const Vector2d& pixel) const {
  return (pixel - pressed_at_).norm() <= kClickPt * pixels_per_point_;
}

void CameraController::handle(const InputEvent& event, const Keymap& keymap,
                              const CameraSubject& subject) {
  switch (event.kind) {
    case InputKind::press:
      motion_ = motion_of(keymap, event.button, event.modifiers);
      cursor_ = pressed_at_ = event.position;
      if (motion_) orbit_center_ = focus(event.position, subject);
      break;
    case InputKind::move:
      drag_to(event.position, subject.diagonal);
      break;
    case InputKind::release:
      drag_to(event.position, subject.diagonal);
      motion_.reset();
      break;
    case InputKind::scroll:
      focus(event.position, subject);
      zoom_by(std::pow(kZoomPerNotch, event.scroll), event.position, subject.diagonal);
      break;
    case InputKind::key:
    case InputKind::text:
      break;
  }
}

void CameraController::begin_orbit(const Vector2d& pixel) {
  motion_ = Motion::orbit;
  orbit_center_ = camera_.target;
  cursor_ = pressed_at_ = pixel;
}

// Focuses the camera on the surface point at `pixel` and returns it. If no surface is there,
// returns the camera's target.
Vector3d CameraController::focus(const Vector2d& pixel, const CameraSubject& subject) {
  const auto point = subject.pick(pixel);
  if (!point) return camera_.target;
  camera_ = focused(camera_, *point);
  return *point;
}

void CameraController::drag_to(const Vector2d& pixel, double diagonal) {
  const Vector2d moved = pixel - cursor_;
  cursor_ = pixel;
  if (!motion_) return;
  switch (*motion_) {
    case Motion::orbit:
      orbit_by(moved, orbit_center_);
      break;
    case Motion::pan:
      camera_ = panned(camera_, moved, size_);
      break;
    case Motion::zoom:
      zoom_by(std::exp((moved.x() - moved.y()) / (kZoomPt * pixels_per_point_)), pressed_at_,
              diagonal);
      break;
  }
}

void CameraController::look_from(View view) {
  camera_ = looking_from(camera_, view_axes(view, up_axis_));
}

void CameraController::orbit_by(const Vector2d& pixels, const Vector3d& center) {
  camera_ = orbited(camera_, pixels, size_, upward(), center);
}

void CameraController::zoom_by(double factor, const Vector2d& cursor, double diagonal) {
  camera_ = zoomed(camera_, factor, cursor, size_, zoom_range(diagonal));
}

}  // namespace lapwing::viewer
