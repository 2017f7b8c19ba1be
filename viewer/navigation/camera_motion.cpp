#include "navigation/camera_motion.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <Eigen/Geometry>

namespace lapwing::viewer {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector2d;
using Eigen::Vector3d;

// Returns the camera's axes as rows: right, up and backward.
Matrix3d rotation_of(const Camera& camera) {
  return camera.view().topLeftCorner<3, 3>();
}

double distance_of(const Camera& camera) {
  return (camera.eye - camera.target).norm();
}

// Returns the length of one pixel at the target's depth.
double length_per_pixel(const Camera& camera, const Vector2d& size) {
  const double half_height =
      std::tan(camera.field_of_view * std::numbers::pi / 360.0) * distance_of(camera);
  return 2.0 * half_height / size.y();
}

// Returns the point under the cursor at the target's depth.
Vector3d under_cursor(const Camera& camera, const Vector2d& cursor, const Vector2d& size) {
  const Ray ray = line_of_sight(camera, cursor, size);
  const Vector3d backward = rotation_of(camera).row(2);
  const double along = backward.dot(camera.target - ray.origin) / backward.dot(ray.direction);
  return ray.origin + along * ray.direction;
}

}  // namespace

ViewAxes axes_of(const Camera& camera) {
  const Matrix3d axes = rotation_of(camera);
  return {axes.row(2), axes.row(1)};
}

Camera focused(const Camera& camera, const Vector3d& point) {
  const Vector3d backward = rotation_of(camera).row(2);
  const double farther = backward.dot(camera.target - point);
  Camera moved = camera;
  moved.target -= farther * backward;
  // An orthographic image depends on the distance between eye and target, but not on their depth.
  if (camera.orthographic) moved.eye -= farther * backward;
  return moved;
}

Camera orbited(const Camera& camera, const Vector2d& pixels, const Vector2d& size,
               const Vector3d& upward, const Vector3d& center) {
  const double angle_per_pixel = std::numbers::pi / size.y();
  const Matrix3d axes = rotation_of(camera);
  const Vector3d right = axes.row(0);
  const Vector3d backward = axes.row(2);
  // The angle between `upward` and the direction from the target to the eye.
  const double polar = std::acos(std::clamp(backward.dot(upward.normalized()), -1.0, 1.0));
  const double wanted = std::clamp(polar - pixels.y() * angle_per_pixel, 0.0, std::numbers::pi);
  const Eigen::AngleAxisd pitch(wanted - polar, right);
  const Eigen::AngleAxisd yaw(-pixels.x() * angle_per_pixel, upward.normalized());
  const Matrix3d turn = (yaw * pitch).toRotationMatrix();
  Camera moved = camera;
  moved.eye = center + turn * (camera.eye - center);
  moved.target = center + turn * (camera.target - center);
  moved.up = turn * axes.row(1).transpose();
  return moved;
}

Camera panned(const Camera& camera, const Vector2d& pixels, const Vector2d& size) {
  const Matrix3d axes = rotation_of(camera);
  const Vector3d step = length_per_pixel(camera, size) *
                        (pixels.y() * axes.row(1) - pixels.x() * axes.row(0)).transpose();
  Camera moved = camera;
  moved.eye += step;
  moved.target += step;
  return moved;
}

ZoomRange zoom_range(double diagonal) {
  constexpr double kSmallest = 1e-12;
  const double size = std::max(diagonal, kSmallest);
  return {1e-3 * size, 1e2 * size};
}

Camera zoomed(const Camera& camera, double factor, const Vector2d& cursor, const Vector2d& size,
              const ZoomRange& range) {
  const double distance = distance_of(camera);
  const double wanted = std::clamp(distance / factor, std::min(range.nearest, distance),
                                   std::max(range.farthest, distance));
  const double share = wanted / distance;
  const Vector3d fixed = under_cursor(camera, cursor, size);
  Camera moved = camera;
  moved.eye = fixed + share * (camera.eye - fixed);
  moved.target = fixed + share * (camera.target - fixed);
  return moved;
}

Camera looking_from(const Camera& camera, const ViewAxes& axes) {
  Camera moved = camera;
  moved.eye = camera.target + distance_of(camera) * axes.toward_eye.normalized();
  moved.up = axes.up;
  return moved;
}

}  // namespace lapwing::viewer
