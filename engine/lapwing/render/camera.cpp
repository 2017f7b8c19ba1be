#include "lapwing/render/camera.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

#include <Eigen/Geometry>

#include "lapwing/base/errors.h"

namespace lapwing {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

struct Interval {
  double low = std::numeric_limits<double>::infinity();
  double high = -std::numeric_limits<double>::infinity();

  void add(double value) {
    low = std::min(low, value);
    high = std::max(high, value);
  }
  double middle() const { return 0.5 * (low + high); }
};

std::array<Vector3d, 8> corners_of(const Bounds& bounds) {
  std::array<Vector3d, 8> corners;
  for (unsigned c = 0; c < 8; ++c) {
    corners[c] = {(c & 1U) != 0 ? bounds.max.x() : bounds.min.x(),
                  (c & 2U) != 0 ? bounds.max.y() : bounds.min.y(),
                  (c & 4U) != 0 ? bounds.max.z() : bounds.min.z()};
  }
  return corners;
}

// Returns the camera's axes as rows: right, up and backward.
Eigen::Matrix3d camera_axes(const Vector3d& toward_eye, const Vector3d& up) {
  const Vector3d backward = toward_eye.normalized();
  Vector3d right = up.cross(backward);
  constexpr double kParallel = 1e-9;
  if (right.norm() <= kParallel * up.norm()) right = backward.unitOrthogonal();
  right.normalize();
  Eigen::Matrix3d axes;
  axes << right.transpose(), backward.cross(right).transpose(), backward.transpose();
  return axes;
}

double half_tangent(double field_of_view) {
  return std::tan(field_of_view * std::numbers::pi / 360.0);
}

// Sets the near and far planes slightly outside `depth`, so that rounding errors clip nothing.
void set_depth(Camera& camera, const Interval& depth) {
  const double slack = 1e-3 * (std::abs(depth.low) + std::abs(depth.high));
  camera.near_distance = depth.low - slack;
  camera.far_distance = depth.high + slack;
  // If a perspective camera is inside the bounds, points behind it are clipped.
  constexpr double kSmallestNear = 1e-4;
  if (!camera.orthographic) {
    camera.far_distance = std::max(camera.far_distance, (camera.eye - camera.target).norm());
    camera.near_distance = std::max(camera.near_distance, kSmallestNear * camera.far_distance);
  }
}

// The points to frame, relative to their centre and in the camera's axes.
struct Framed {
  std::vector<Vector3d> points;
  Interval x, y;
  double right_tangent, up_tangent;  // tangents of half the field of view without the margin
  double smallest;  // lower bound of the shown size; else a line seen end-on would have size 0

  // Returns the smallest distance from the target (dx, dy, 0) at which all points are in the image.
  double distance(double dx, double dy, bool orthographic) const {
    double least = 0.0;
    for (const Vector3d& p : points) {
      const double size = std::max({std::abs(p.x() - dx) / right_tangent,
                                    std::abs(p.y() - dy) / up_tangent, smallest / up_tangent});
      least = std::max(least, orthographic ? size : size + p.z());
    }
    return least;
  }
};

Vector3d target_and_distance(const Framed& framed, bool orthographic) {
  Vector3d result(framed.x.middle(), framed.y.middle(), 0.0);
  result.z() = framed.distance(result.x(), result.y(), orthographic);
  if (orthographic) return result;
  // In perspective, the centre of the image is not the centre of the points, because near points
  // appear farther apart. This fixed-point iteration converges at the rate depth / distance.
  for (int round = 0; round < 8; ++round) {
    Interval x;
    Interval y;
    for (const Vector3d& p : framed.points) {
      x.add((p.x() - result.x()) / (result.z() - p.z()));
      y.add((p.y() - result.y()) / (result.z() - p.z()));
    }
    result.x() += x.middle() * result.z();
    result.y() += y.middle() * result.z();
    result.z() = framed.distance(result.x(), result.y(), false);
  }
  return result;
}

constexpr std::array<std::pair<std::string_view, View>, 7> kViewNames{{
    {"three-quarter", View::three_quarter},
    {"front", View::front},
    {"back", View::back},
    {"left", View::left},
    {"right", View::right},
    {"top", View::top},
    {"bottom", View::bottom},
}};

ViewAxes view_axes_y_up(View view) {
  const Vector3d x = Vector3d::UnitX();
  const Vector3d y = Vector3d::UnitY();
  const Vector3d z = Vector3d::UnitZ();
  switch (view) {
    case View::three_quarter:
      return {Vector3d(0.6, 0.35, 1.0).normalized(), y};
    case View::front:
      return {z, y};
    case View::back:
      return {-z, y};
    case View::left:
      return {-x, y};
    case View::right:
      return {x, y};
    case View::top:
      return {y, -z};
    case View::bottom:
      return {-y, z};
  }
  return {z, y};
}

}  // namespace

Eigen::Matrix4d Camera::view() const {
  const Eigen::Matrix3d axes = camera_axes(eye - target, up);
  Eigen::Matrix4d matrix = Eigen::Matrix4d::Identity();
  matrix.topLeftCorner<3, 3>() = axes;
  matrix.topRightCorner<3, 1>() = -axes * eye;
  return matrix;
}

Eigen::Matrix4d Camera::projection(double aspect) const {
  const double range = far_distance - near_distance;
  Eigen::Matrix4d matrix = Eigen::Matrix4d::Zero();
  const double tangent = half_tangent(field_of_view);
  if (orthographic) {
    const double half_height = tangent * (eye - target).norm();
    matrix(0, 0) = 1.0 / (half_height * aspect);
    matrix(1, 1) = -1.0 / half_height;
    matrix(0, 3) = target_across;
    matrix(2, 2) = 1.0 / range;
    matrix(2, 3) = far_distance / range;
    matrix(3, 3) = 1.0;
  } else {
    matrix(0, 0) = 1.0 / (tangent * aspect);
    matrix(1, 1) = -1.0 / tangent;
    matrix(0, 2) = -target_across;
    matrix(2, 2) = near_distance / range;
    matrix(2, 3) = near_distance * far_distance / range;
    matrix(3, 2) = -1.0;
  }
  return matrix;
}

Ray line_of_sight(const Camera& camera, const Vector2d& pixel, const Vector2d& size) {
  const double tangent = half_tangent(camera.field_of_view);
  const Vector3d slope(
      (2.0 * pixel.x() / size.x() - 1.0 - camera.target_across) * tangent * size.x() / size.y(),
      (1.0 - 2.0 * pixel.y() / size.y()) * tangent, -1.0);
  const Eigen::Matrix3d axes = camera_axes(camera.eye - camera.target, camera.up);
  Ray ray;
  if (camera.orthographic) {
    const double distance = (camera.eye - camera.target).norm();
    const Vector3d start(slope.x() * distance, slope.y() * distance, -camera.near_distance);
    ray.origin = camera.eye + axes.transpose() * start;
    ray.direction = -axes.row(2).transpose();
  } else {
    ray.origin = camera.eye + axes.transpose() * (camera.near_distance * slope);
    ray.direction = (axes.transpose() * slope).normalized();
  }
  return ray;
}

ViewAxes view_axes(View view, UpAxis up_axis) {
  const ViewAxes axes = view_axes_y_up(view);
  if (up_axis == UpAxis::y) return axes;
  const auto turned = [](const Vector3d& v) { return Vector3d(v.x(), -v.z(), v.y()); };
  return {turned(axes.toward_eye), turned(axes.up)};
}

View view_named(std::string_view name) {
  std::string known;
  for (const auto& [known_name, view] : kViewNames) {
    if (name == known_name) return view;
    known += (known.empty() ? "" : ", ") + std::string(known_name);
  }
  throw InputError("unknown view \"" + std::string(name) + "\"; choose one of " + known);
}

Camera fit(std::span<const Vector3d> points, const ViewAxes& axes, double aspect,
           const Framing& framing) {
  const Bounds bounds = bounds_of(points);
  const Vector3d center = bounds.center();
  if (bounds.diagonal() == 0.0) {
    const Vector3d half = Vector3d::Constant(0.5);
    return fit(Bounds{center - half, center + half}, axes, aspect, framing);
  }
  const Eigen::Matrix3d rows = camera_axes(axes.toward_eye, axes.up);
  const double tangent = half_tangent(framing.field_of_view) * (1.0 - 2.0 * framing.margin);
  constexpr double kSmallestPart = 1e-3;
  Framed framed{{},      {},
                {},      tangent * aspect * (1.0 - framing.legend),
                tangent, kSmallestPart * bounds.diagonal()};
  framed.points.reserve(points.size());
  Interval z;
  for (const Vector3d& point : points) {
    if (!point.allFinite()) continue;
    const Vector3d& p = framed.points.emplace_back(rows * (point - center));
    framed.x.add(p.x());
    framed.y.add(p.y());
    z.add(p.z());
  }
  const Vector3d found = target_and_distance(framed, framing.orthographic);

  Camera camera;
  camera.field_of_view = framing.field_of_view;
  camera.orthographic = framing.orthographic;
  camera.up = axes.up;
  camera.target_across = -framing.legend;
  camera.target = center + rows.transpose() * Vector3d(found.x(), found.y(), 0.0);
  camera.eye = camera.target + found.z() * rows.row(2).transpose();
  set_depth(camera, {found.z() - z.high, found.z() - z.low});
  return camera;
}

Camera fit(const Bounds& bounds, const ViewAxes& axes, double aspect, const Framing& framing) {
  return fit(corners_of(bounds), axes, aspect, framing);
}

void fit_depth(Camera& camera, const Bounds& bounds) {
  const Eigen::Matrix4d view = camera.view();
  Interval depth;
  for (const Vector3d& corner : corners_of(bounds)) {
    depth.add(-(view * corner.homogeneous()).z());
  }
  set_depth(camera, depth);
}

}  // namespace lapwing
