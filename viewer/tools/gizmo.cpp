#include "tools/gizmo.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include <Eigen/Geometry>

#include "tools/screen_geometry.h"

namespace lapwing::viewer {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr double kReachPt = 8.0;
constexpr double kMiddlePt = 12.0;
constexpr double kViewRingPt = 1.2 * kArmPt;
// In arm lengths: the start of an arm, and the near and far edges of a plane.
constexpr double kArmStart = 0.15;
constexpr double kPlaneStart = 0.25;
constexpr double kPlaneEnd = 0.5;
// An arm within 11 degrees of the line of sight (a cosine), or a plane seen that close to its edge
// (a sine), would move wildly with the cursor.
constexpr double kAlongSight = 0.98;
constexpr double kEdgeOn = 0.2;
constexpr int kRingPoints = 64;

double distance_to_line(const Vector2d& p, const GizmoLine& line) {
  if (is_plane(line.part) && is_in_polygon(p, line.pixels)) return 0.0;
  double least = std::numeric_limits<double>::infinity();
  const std::size_t count = line.pixels.size();
  for (std::size_t k = 0; k + (line.closed ? 0 : 1) < count; ++k) {
    least = std::min(least, distance_to_segment(p, line.pixels[k], line.pixels[(k + 1) % count]));
  }
  return least;
}

constexpr double angle_of(int k) {
  return 2.0 * std::numbers::pi * k / kRingPoints;
}

// The half of the ring about axis `a` that faces the eye: the unit directions from the centre to
// its middle, `front`, and to one end, `side`.
struct HalfRing {
  HalfRing(const Gizmo& gizmo, int a, const Vector3d& toward_eye) {
    const Vector3d axis = gizmo.axes.col(a);
    front = toward_eye - toward_eye.dot(axis) * axis;
    if (front.norm() < 1e-6) front = gizmo.axes.col((a + 1) % 3);  // the whole ring faces the eye
    front.normalize();
    side = axis.cross(front);
  }
  Vector3d front;
  Vector3d side;
};

}  // namespace

// Starts the next line without pixels, in the memory of an earlier frame.
GizmoLine& GizmoLines::begin(GizmoPart part, bool closed) {
  if (count_ == lines_.size()) lines_.emplace_back();
  GizmoLine& line = lines_[count_++];
  line.part = part;
  line.closed = closed;
  line.pixels.clear();
  return line;
}

template <typename PointAt>
void GizmoLines::add(GizmoPart part, bool closed, int points, const Projection& projection,
                     const PointAt& point_at) {
  GizmoLine& line = begin(part, closed);
  for (int k = 0; k < points; ++k) {
    const auto pixel = projection.to_pixel(point_at(k));
    if (!pixel) {
      --count_;
      return;
    }
    line.pixels.push_back(*pixel);
  }
}

void GizmoLines::add_circle(const Vector2d& center, double radius) {
  GizmoLine& line = begin(GizmoPart::view, true);
  for (int k = 0; k < kRingPoints; ++k) {
    line.pixels.emplace_back(center +
                             radius * Vector2d(std::cos(angle_of(k)), std::sin(angle_of(k))));
  }
}

void GizmoLines::add_rings(const Gizmo& gizmo, double arm, const Projection& projection) {
  const Vector3d toward_eye = projection.toward_eye(gizmo.center);
  for (int a = 0; a < 3; ++a) {
    const HalfRing half(gizmo, a, toward_eye);
    add(part_of_axis(a, false), false, kRingPoints / 2 + 1, projection, [&](int k) -> Vector3d {
      const double angle = angle_of(k) - 0.5 * std::numbers::pi;
      return gizmo.center + arm * (std::cos(angle) * half.front + std::sin(angle) * half.side);
    });
  }
  add_circle(*projection.to_pixel(gizmo.center), projection.in_pixels(kViewRingPt));
}

void GizmoLines::add_arms(const Gizmo& gizmo, double arm, const Projection& projection) {
  const Vector3d toward_eye = projection.toward_eye(gizmo.center);
  for (int a = 0; a < 3; ++a) {
    const Vector3d axis = arm * gizmo.axes.col(a);
    if (std::abs(gizmo.axes.col(a).dot(toward_eye)) > kAlongSight) continue;
    add(part_of_axis(a, false), false, 2, projection,
        [&](int k) -> Vector3d { return gizmo.center + (k == 0 ? kArmStart : 1.0) * axis; });
  }
  constexpr std::array<double, 4> kAlong{kPlaneStart, kPlaneEnd, kPlaneEnd, kPlaneStart};
  constexpr std::array<double, 4> kAcross{kPlaneStart, kPlaneStart, kPlaneEnd, kPlaneEnd};
  for (int a = 0; a < 3; ++a) {
    if (std::abs(gizmo.axes.col(a).dot(toward_eye)) < kEdgeOn) continue;
    const Vector3d u = arm * gizmo.axes.col((a + 1) % 3);
    const Vector3d v = arm * gizmo.axes.col((a + 2) % 3);
    add(part_of_axis(a, true), true, 4, projection, [&](int k) -> Vector3d {
      const auto corner = static_cast<std::size_t>(k);
      return gizmo.center + kAlong[corner] * u + kAcross[corner] * v;
    });
  }
  add_circle(*projection.to_pixel(gizmo.center), projection.in_pixels(kMiddlePt - kReachPt));
}

void GizmoLines::renew(const Gizmo& gizmo, const Projection& projection) {
  count_ = 0;
  if (!projection.to_pixel(gizmo.center)) return;
  const double arm = projection.in_pixels(kArmPt) * projection.length_of_pixel(gizmo.center);
  if (gizmo.mode == GizmoMode::rotate) {
    add_rings(gizmo, arm, projection);
  } else {
    add_arms(gizmo, arm, projection);
  }
}

int axis_of(GizmoPart part) {
  if (part == GizmoPart::none || part == GizmoPart::view) return -1;
  return (static_cast<int>(part) - static_cast<int>(GizmoPart::x)) % 3;
}

bool is_plane(GizmoPart part) {
  return part >= GizmoPart::without_x && part <= GizmoPart::without_z;
}

GizmoPart part_of_axis(int axis, bool plane) {
  const GizmoPart first = plane ? GizmoPart::without_x : GizmoPart::x;
  return static_cast<GizmoPart>(static_cast<int>(first) + axis);
}

std::optional<GizmoMode> mode_of_key(int key) {
  if (key == 'W') return GizmoMode::translate;
  if (key == 'E') return GizmoMode::rotate;
  if (key == 'Q') return GizmoMode::scale;
  return std::nullopt;
}

GizmoPart hit_gizmo(const Gizmo& gizmo, const Projection& projection, const Vector2d& pixel) {
  GizmoPart nearest = GizmoPart::none;
  double least = projection.in_pixels(kReachPt);
  const GizmoLines lines(gizmo, projection);
  for (const bool planes : {false, true}) {
    if (nearest != GizmoPart::none) break;
    for (const GizmoLine& line : lines.lines()) {
      if (is_plane(line.part) != planes) continue;
      const double distance = distance_to_line(pixel, line);
      if (distance >= least) continue;
      least = distance;
      nearest = line.part;
    }
  }
  return nearest;
}

}  // namespace lapwing::viewer
