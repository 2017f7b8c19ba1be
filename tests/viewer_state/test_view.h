#pragma once

#include <cmath>
#include <numbers>

#include <Eigen/Geometry>

#include "tools/input.h"
#include "tools/projection.h"

namespace lapwing::viewer::test {

using Eigen::Vector2d;
using Eigen::Vector3d;

inline const Vector2d kWindow(800.0, 600.0);

/// From world to camera space: x right, y up, looking along -z.
inline Eigen::Matrix4d look_at(const Vector3d& eye, const Vector3d& target, const Vector3d& up) {
  Eigen::Matrix3d axes;
  axes.col(2) = (eye - target).normalized();
  axes.col(0) = up.cross(axes.col(2)).normalized();
  axes.col(1) = axes.col(2).cross(axes.col(0));
  Eigen::Matrix4d view = Eigen::Matrix4d::Identity();
  view.topLeftCorner<3, 3>() = axes.transpose();
  view.topRightCorner<3, 1>() = -axes.transpose() * eye;
  return view;
}

/// As the renderer's camera: y down, depth 1 near and 0 far. The window is as large in points on
/// every display.
inline Projection perspective(const Vector3d& eye, const Vector3d& target,
                              const Vector3d& up = Vector3d::UnitY(),
                              double pixels_per_point = 1.0) {
  const double near = 0.1;
  const double far = 100.0;
  const double f = 1.0 / std::tan(15.0 * std::numbers::pi / 180.0);
  Eigen::Matrix4d clip = Eigen::Matrix4d::Zero();
  clip(0, 0) = f * kWindow.y() / kWindow.x();
  clip(1, 1) = -f;
  clip(2, 2) = near / (far - near);
  clip(2, 3) = near * far / (far - near);
  clip(3, 2) = -1.0;
  return {clip * look_at(eye, target, up), pixels_per_point * kWindow, pixels_per_point};
}

/// Parallel, `height` of the world in the window's height.
inline Projection parallel(const Vector3d& eye, const Vector3d& target, double height,
                           const Vector3d& up = Vector3d::UnitY(),
                           const Vector2d& window = kWindow) {
  const double far = 100.0;
  Eigen::Matrix4d clip = Eigen::Matrix4d::Identity();
  clip(0, 0) = 2.0 / height * window.y() / window.x();
  clip(1, 1) = -2.0 / height;
  clip(2, 2) = 1.0 / far;
  clip(2, 3) = 1.0;
  return {clip * look_at(eye, target, up), window};
}

inline InputEvent at(InputKind kind, const Vector2d& pixel, MouseButton button = MouseButton::none,
                     Modifiers modifiers = {}) {
  return {.kind = kind, .position = pixel, .button = button, .modifiers = modifiers};
}
inline InputEvent press(const Vector2d& pixel, Modifiers modifiers = {}) {
  return at(InputKind::press, pixel, MouseButton::left, modifiers);
}
inline InputEvent release(const Vector2d& pixel, Modifiers modifiers = {}) {
  return at(InputKind::release, pixel, MouseButton::left, modifiers);
}
inline InputEvent move_to(const Vector2d& pixel, Modifiers modifiers = {}) {
  return at(InputKind::move, pixel, MouseButton::none, modifiers);
}
inline InputEvent key(int key, Modifiers modifiers = {}) {
  return {.kind = InputKind::key, .modifiers = modifiers, .key = key};
}
inline InputEvent typed(char32_t text) {
  return {.kind = InputKind::text, .text = text};
}
inline InputEvent scrolled(const Vector2d& pixel, double amount, Modifiers modifiers = {}) {
  return {.kind = InputKind::scroll, .position = pixel, .modifiers = modifiers, .scroll = amount};
}

}  // namespace lapwing::viewer::test
