#include "lapwing/render/turntable.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include <Eigen/Geometry>

namespace lapwing {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

// Number of corners of the polygon that encloses the circle on which a point turns.
constexpr int kCircleCorners = 128;
constexpr double kCornerAngle = 2.0 * std::numbers::pi / kCircleCorners;

double cross(const Vector2d& a, const Vector2d& b) {
  return a.x() * b.y() - a.y() * b.x();
}

// Returns the corners of the convex hull (Andrew 1979).
std::vector<Vector2d> convex_hull(std::vector<Vector2d> points) {
  std::ranges::sort(points, {}, [](const Vector2d& p) { return std::pair(p.x(), p.y()); });
  const auto half = [](const auto& sorted) {
    std::vector<Vector2d> chain;
    for (const Vector2d& p : sorted) {
      while (chain.size() >= 2 &&
             cross(chain.back() - chain[chain.size() - 2], p - chain.back()) <= 0.0) {
        chain.pop_back();
      }
      chain.push_back(p);
    }
    return chain;
  };
  std::vector<Vector2d> hull = half(points);
  std::ranges::reverse(points);
  const std::vector<Vector2d> other = half(points);
  hull.insert(hull.end(), other.begin(), other.end());
  return hull;
}

// Returns points whose convex hull contains the paths of all `points` as they turn about the axis.
// The distance that a camera needs is a convex function of the point, so it suffices to frame these
// points. They are symmetric about the plane of the axis and `front`, a unit vector perpendicular
// to the axis.
std::vector<Vector3d> swept_corners(std::span<const Vector3d> points, const Vector3d& middle,
                                    const Vector3d& upward, const Vector3d& front) {
  std::vector<Vector2d> profile;  // distance from the axis, and height
  profile.reserve(points.size());
  for (const Vector3d& point : points) {
    if (!point.allFinite()) continue;
    const Vector3d offset = point - middle;
    const double height = offset.dot(upward);
    profile.emplace_back((offset - height * upward).norm(), height);
  }
  const Vector3d side = upward.cross(front);
  const double outwards = 1.0 / std::cos(0.5 * kCornerAngle);
  std::vector<Vector3d> corners;
  for (const Vector2d& p : convex_hull(std::move(profile))) {
    for (int k = 0; k < kCircleCorners; ++k) {
      const double angle = (k + 0.5) * kCornerAngle;
      const Vector3d direction = std::cos(angle) * front + std::sin(angle) * side;
      corners.emplace_back(middle + outwards * p.x() * direction + p.y() * upward);
    }
  }
  return corners;
}

}  // namespace

Turntable::Turntable(std::span<const Vector3d> points, const ViewAxes& first, UpAxis up_axis,
                     double aspect, const Framing& framing)
    : middle_(bounds_of(points).center()),
      upward_(up_axis == UpAxis::y ? Vector3d::UnitY() : Vector3d::UnitZ()) {
  Vector3d front = first.toward_eye - first.toward_eye.dot(upward_) * upward_;
  // If the view is along the axis, the up direction of the image defines the plane of symmetry.
  if (front.norm() <= 1e-6 * first.toward_eye.norm()) front = first.up;
  first_ = fit(swept_corners(points, middle_, upward_, front.normalized()), first, aspect, framing);
}

Camera Turntable::camera(int step, int steps) const {
  const Eigen::AngleAxisd turn(2.0 * std::numbers::pi * step / steps, upward_);
  Camera camera = first_;
  camera.eye = middle_ + turn * (first_.eye - middle_);
  camera.target = middle_ + turn * (first_.target - middle_);
  camera.up = turn * first_.up;
  return camera;
}

}  // namespace lapwing
