#include "tools/gizmo.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>

#include <Eigen/Geometry>

#include "tools/plane_geometry.h"

namespace lapwing::viewer {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr double kReachPixels = 8.0;
constexpr double kMiddlePixels = 12.0;
constexpr double kViewRingPixels = 1.2 * kArmPixels;
// Arms begin outside the middle, planes lie between a quarter and half an arm.
constexpr double kArmStart = 0.15;
constexpr double kPlaneStart = 0.25;
constexpr double kPlaneEnd = 0.5;
// An arm nearer than this to the line of sight, or a plane so nearly seen from its edge, moves
// wildly with the hand (as a cosine and sine, 11 degrees).
constexpr double kAlongSight = 0.98;
constexpr double kEdgeOn = 0.2;
constexpr int kRingPoints = 64;

constexpr std::array kAxes{GizmoPart::x, GizmoPart::y, GizmoPart::z};
constexpr std::array kPlanes{GizmoPart::without_x, GizmoPart::without_y, GizmoPart::without_z};

double distance_to_line(const Vector2d& p, const GizmoLine& line) {
  if (is_plane(line.part) && is_in_polygon(p, line.pixels)) return 0.0;
  double least = std::numeric_limits<double>::infinity();
  const std::size_t count = line.pixels.size();
  for (std::size_t k = 0; k + (line.closed ? 0 : 1) < count; ++k) {
    least = std::min(least, distance_to_segment(p, line.pixels[k], line.pixels[(k + 1) % count]));
  }
  return least;
}

std::optional<GizmoLine> line_of(GizmoPart part, const std::vector<Vector3d>& points, bool closed,
                                 const Projection& projection) {
  GizmoLine line{part, {}, closed};
  for (const Vector3d& point : points) {
    const auto pixel = projection.to_pixel(point);
    if (!pixel) return std::nullopt;
    line.pixels.push_back(*pixel);
  }
  return line;
}

GizmoLine circle(const Vector2d& center, double radius) {
  GizmoLine line{GizmoPart::view, {}, true};
  for (int k = 0; k < kRingPoints; ++k) {
    const double angle = 2.0 * std::numbers::pi * k / kRingPoints;
    line.pixels.emplace_back(center + radius * Vector2d(std::cos(angle), std::sin(angle)));
  }
  return line;
}

// The half of the ring about axis `a` that faces the eye, which stands at `toward_eye`.
std::vector<Vector3d> half_ring(const Gizmo& gizmo, int a, double radius,
                                const Vector3d& toward_eye) {
  const Vector3d axis = gizmo.axes.col(a);
  Vector3d front = toward_eye - toward_eye.dot(axis) * axis;
  if (front.norm() < 1e-6) front = gizmo.axes.col((a + 1) % 3);  // any half: all of it faces
  front.normalize();
  const Vector3d side = axis.cross(front);
  std::vector<Vector3d> points;
  for (int k = 0; k <= kRingPoints / 2; ++k) {
    const double angle = 2.0 * std::numbers::pi * k / kRingPoints - 0.5 * std::numbers::pi;
    points.push_back(gizmo.center + radius * (std::cos(angle) * front + std::sin(angle) * side));
  }
  return points;
}

void add_rings(const Gizmo& gizmo, double arm, const Projection& projection,
               std::vector<GizmoLine>& lines) {
  const Vector3d toward_eye = projection.toward_eye(gizmo.center);
  for (int a = 0; a < 3; ++a) {
    auto line = line_of(kAxes[static_cast<std::size_t>(a)], half_ring(gizmo, a, arm, toward_eye),
                        false, projection);
    if (line) lines.push_back(*std::move(line));
  }
  lines.push_back(circle(*projection.to_pixel(gizmo.center), kViewRingPixels));
}

void add_arms(const Gizmo& gizmo, double arm, const Projection& projection,
              std::vector<GizmoLine>& lines) {
  const Vector3d toward_eye = projection.toward_eye(gizmo.center);
  for (int a = 0; a < 3; ++a) {
    const Vector3d axis = arm * gizmo.axes.col(a);
    if (std::abs(gizmo.axes.col(a).dot(toward_eye)) > kAlongSight) continue;
    auto line = line_of(kAxes[static_cast<std::size_t>(a)],
                        {gizmo.center + kArmStart * axis, gizmo.center + axis}, false, projection);
    if (line) lines.push_back(*std::move(line));
  }
  for (int a = 0; a < 3; ++a) {
    if (std::abs(gizmo.axes.col(a).dot(toward_eye)) < kEdgeOn) continue;
    const Vector3d u = arm * gizmo.axes.col((a + 1) % 3);
    const Vector3d v = arm * gizmo.axes.col((a + 2) % 3);
    const auto corner = [&](double s, double t) -> Vector3d {
      return gizmo.center + s * u + t * v;
    };
    auto line = line_of(kPlanes[static_cast<std::size_t>(a)],
                        {corner(kPlaneStart, kPlaneStart), corner(kPlaneEnd, kPlaneStart),
                         corner(kPlaneEnd, kPlaneEnd), corner(kPlaneStart, kPlaneEnd)},
                        true, projection);
    if (line) lines.push_back(*std::move(line));
  }
  lines.push_back(circle(*projection.to_pixel(gizmo.center), kMiddlePixels - kReachPixels));
}

}  // namespace

int axis_of(GizmoPart part) {
  switch (part) {
    case GizmoPart::x:
    case GizmoPart::without_x:
      return 0;
    case GizmoPart::y:
    case GizmoPart::without_y:
      return 1;
    case GizmoPart::z:
    case GizmoPart::without_z:
      return 2;
    default:
      return -1;
  }
}

bool is_plane(GizmoPart part) {
  return part == GizmoPart::without_x || part == GizmoPart::without_y ||
         part == GizmoPart::without_z;
}

std::vector<GizmoLine> gizmo_lines(const Gizmo& gizmo, const Projection& projection) {
  std::vector<GizmoLine> lines;
  if (!projection.to_pixel(gizmo.center)) return lines;
  const double arm = kArmPixels * projection.length_of_pixel(gizmo.center);
  if (gizmo.mode == GizmoMode::rotate) {
    add_rings(gizmo, arm, projection, lines);
  } else {
    add_arms(gizmo, arm, projection, lines);
  }
  return lines;
}

GizmoPart hit_gizmo(const Gizmo& gizmo, const Projection& projection, const Vector2d& pixel) {
  GizmoPart nearest = GizmoPart::none;
  double least = kReachPixels;
  const std::vector<GizmoLine> lines = gizmo_lines(gizmo, projection);
  for (const bool planes : {false, true}) {
    if (nearest != GizmoPart::none) break;
    for (const GizmoLine& line : lines) {
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
