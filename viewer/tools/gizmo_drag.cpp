#include "tools/gizmo_drag.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <Eigen/LU>

#include "lapwing/deform/turn_tracker.h"
#include "state/app_state.h"

namespace lapwing::viewer {
namespace {

using Eigen::Affine3d;
using Eigen::AngleAxisd;
using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr double kDegrees = 180.0 / std::numbers::pi;

// A factor of 0 could not be undone, and a negative one would mirror the handle.
constexpr double kSmallestFactor = 0.01;

// Below this cosine of its axis to the line of sight, a ring is dragged along its tangent.
constexpr double kRingFromItsEdge = 0.25;

// Largest substep of a turn. TurnTracker needs less than 180 degrees to know the direction.
constexpr double kDegreesFollowed = 60.0;

double snapped(double value, double step) {
  return step * std::round(value / step);
}

}  // namespace

double snap_length(const Gizmo& gizmo, const Projection& projection) {
  const double wanted =
      0.1 * projection.in_pixels(kArmPt) * projection.length_of_pixel(gizmo.center);
  if (!(wanted > 0.0)) return 1.0;
  const double power = std::pow(10.0, std::floor(std::log10(wanted)));
  for (const double digit : {1.0, 2.0, 5.0}) {
    if (digit * power >= wanted) return digit * power;
  }
  return 10.0 * power;
}

GizmoDrag::GizmoDrag(const Gizmo& gizmo, GizmoPart part, const Projection& projection,
                     const Vector2d& start)
    : gizmo_(gizmo),
      part_(part),
      projection_(projection),
      toward_eye_(projection.toward_eye(gizmo.center)),
      start_(start),
      center_pixel_(projection.to_pixel(gizmo.center).value_or(start)),
      last_(start) {}

// Returns the axis of a ring or arm, the normal of a plane, or the line of sight for the view.
Vector3d GizmoDrag::axis() const {
  const int a = axis_of(part_);
  return a < 0 ? toward_eye_ : Vector3d(gizmo_.axes.col(a));
}

// Returns the point under the cursor on the part's line or plane.
Vector3d GizmoDrag::point_on_part(const Vector2d& pixel) const {
  const Ray ray = projection_.ray_through(pixel);
  const bool along_line = axis_of(part_) >= 0 && !is_plane(part_);
  // Of the planes through a line, use the one that faces the eye most.
  const Vector3d normal = along_line ? Vector3d(axis().cross(toward_eye_).cross(axis())) : axis();
  const double slope = ray.direction.dot(normal);
  if (std::abs(slope) < 1e-9) return gizmo_.center;
  const double t = (gizmo_.center - ray.origin).dot(normal) / slope;
  const Vector3d point = ray.origin + t * ray.direction;
  if (!along_line) return point;
  return gizmo_.center + (point - gizmo_.center).dot(axis()) * axis();
}

// Returns the angle about the axis in radians, up to a constant.
double GizmoDrag::angle_at(const Vector2d& pixel) const {
  const double facing = axis().dot(toward_eye_);
  if (std::abs(facing) < kRingFromItsEdge) {
    const Vector3d tangent = axis().cross(toward_eye_).normalized();
    const double arm = projection_.in_pixels(kArmPt);
    const auto ahead = projection_.to_pixel(
        gizmo_.center + arm * projection_.length_of_pixel(gizmo_.center) * tangent);
    if (!ahead) return 0.0;
    return (pixel - center_pixel_).dot((*ahead - center_pixel_).normalized()) / arm;
  }
  if (part_ == GizmoPart::view) {
    // On the screen y points down, which flips the sign of the angle.
    const Vector2d across = pixel - center_pixel_;
    return -std::atan2(across.y(), across.x());
  }
  const Ray ray = projection_.ray_through(pixel);
  const double t = (gizmo_.center - ray.origin).dot(axis()) / ray.direction.dot(axis());
  const Vector3d across = ray.origin + t * ray.direction - gizmo_.center;
  const Vector3d u = gizmo_.axes.col((axis_of(part_) + 1) % 3);
  const Vector3d v = gizmo_.axes.col((axis_of(part_) + 2) % 3);
  return std::atan2(across.dot(v), across.dot(u));
}

double GizmoDrag::factor_at(const Vector2d& pixel) const {
  if (axis_of(part_) >= 0 && !is_plane(part_)) {
    const double from = (point_on_part(start_) - gizmo_.center).dot(axis());
    const double to = (point_on_part(pixel) - gizmo_.center).dot(axis());
    if (from != 0.0) return to / from;
  }
  // Near the middle a ratio is unstable. There, dragging right by an arm's length doubles the size.
  const double from = (start_ - center_pixel_).norm();
  const double arm = projection_.in_pixels(kArmPt);
  if (from < 0.25 * arm) return 1.0 + (pixel - start_).x() / arm;
  return (pixel - center_pixel_).norm() / from;
}

// Returns 1 for each axis that a length or factor applies to, else 0.
Eigen::Array3d GizmoDrag::moved_axes() const {
  const int a = axis_of(part_);
  if (a < 0) return Eigen::Array3d::Ones();
  const Eigen::Array3d alone = Vector3d::Unit(a).array();
  return is_plane(part_) ? Eigen::Array3d(1.0 - alone) : alone;
}

void GizmoDrag::move_to(const Vector2d& pixel) {
  switch (gizmo_.mode) {
    case GizmoMode::translate:
      dragged_.lengths = gizmo_.axes.transpose() * (point_on_part(pixel) - point_on_part(start_));
      break;
    case GizmoMode::rotate: {
      const double step = angle_at(pixel) - angle_at(last_);
      dragged_.degrees += std::remainder(step, 2.0 * std::numbers::pi) * kDegrees;
      break;
    }
    case GizmoMode::scale: {
      const double factor = std::max(factor_at(pixel), kSmallestFactor);
      dragged_.factors = (1.0 + (factor - 1.0) * moved_axes()).matrix();
    }
  }
  last_ = pixel;
}

void GizmoDrag::move_center_to(const Vector3d& place) {
  const Vector3d along = gizmo_.axes.transpose() * (place - gizmo_.center);
  dragged_.lengths = (moved_axes() * along.array()).matrix();
}

GizmoAmount GizmoDrag::amount(const std::optional<SnapSteps>& snap,
                              const std::optional<double>& typed) const {
  GizmoAmount amount = dragged_;
  if (typed) {
    // A number typed for the view moves to the right of the picture.
    const Vector3d right = projection_.ray_through(center_pixel_ + Vector2d::UnitX()).origin -
                           projection_.ray_through(center_pixel_).origin;
    amount.lengths = part_ == GizmoPart::view
                         ? Vector3d(gizmo_.axes.transpose() * right.normalized() * *typed)
                         : Vector3d(*typed * moved_axes().matrix());
    amount.degrees = *typed;
    amount.factors = (1.0 + (std::max(*typed, kSmallestFactor) - 1.0) * moved_axes()).matrix();
  } else if (snap) {
    for (Eigen::Index k = 0; k < 3; ++k) {
      amount.lengths[k] = snapped(amount.lengths[k], snap->length);
      amount.factors[k] = std::max(snapped(amount.factors[k], snap->factor), kSmallestFactor);
    }
    amount.degrees = snapped(amount.degrees, snap->degrees);
  }
  return amount;
}

Affine3d GizmoDrag::motion(const GizmoAmount& amount) const {
  Affine3d map = Affine3d::Identity();
  switch (gizmo_.mode) {
    case GizmoMode::translate:
      map.translation() = gizmo_.axes * amount.lengths;
      return map;
    case GizmoMode::rotate:
      map.linear() = AngleAxisd(amount.degrees / kDegrees, axis()).toRotationMatrix();
      break;
    case GizmoMode::scale:
      map.linear() = gizmo_.axes * amount.factors.asDiagonal() * gizmo_.axes.transpose();
  }
  map.translation() = gizmo_.center - map.linear() * gizmo_.center;
  return map;
}

Move GizmoDrag::move_after(const Move& before, const Vector3d& handle_centroid,
                           const GizmoAmount& amount) const {
  if (amount == GizmoAmount{}) return before;
  TurnTracker tracker;
  // Replays both turns in substeps small enough to know the direction. The result does not depend
  // on the path of the cursor.
  const auto steps = [](double degrees) {
    return 1 + static_cast<int>(std::abs(degrees) / kDegreesFollowed);
  };
  const int before_steps = mirrors(before) ? 0 : steps(turn_of(before).degrees);
  for (int k = 1; k <= before_steps; ++k) {
    tracker.follow(to_affine(before, handle_centroid, static_cast<double>(k) / before_steps));
  }
  const Affine3d there = to_affine(before, handle_centroid);
  const int drag_steps = steps(amount.degrees);
  for (int k = 1; k < drag_steps; ++k) {
    GizmoAmount part = amount;
    part.degrees = amount.degrees * k / drag_steps;
    tracker.follow(motion(part) * there);
  }
  const Affine3d whole = motion(amount) * there;
  tracker.follow(whole);
  return to_move(whole, AngleAxisd(tracker.degrees() / kDegrees, tracker.axis()), handle_centroid);
}

}  // namespace lapwing::viewer
