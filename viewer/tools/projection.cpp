#include "tools/projection.h"

#include <algorithm>
#include <compare>
#include <limits>
#include <vector>

#include <Eigen/Geometry>
#include <Eigen/LU>

#include "lapwing/base/parallel.h"

namespace lapwing::viewer {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;
using Eigen::Vector4d;

constexpr double kNear = 1.0;
constexpr double kFar = 0.0;

constexpr double kMiss = std::numeric_limits<double>::infinity();

// Returns the distance along the ray (Moeller and Trumbore 1997); infinity if it misses.
double distance_to(const Triangle& triangle, std::span<const Vector3d> positions, const Ray& ray) {
  const Vector3d& a = positions[triangle[0]];
  const Vector3d& b = positions[triangle[1]];
  const Vector3d& c = positions[triangle[2]];
  const Vector3d p = ray.direction.cross(c - a);
  const double determinant = p.dot(b - a);
  if (determinant == 0.0) return kMiss;
  const Vector3d from_a = ray.origin - a;
  const double u = p.dot(from_a) / determinant;
  const Vector3d q = from_a.cross(b - a);
  const double v = q.dot(ray.direction) / determinant;
  const double t = q.dot(c - a) / determinant;
  const bool inside = u >= 0.0 && v >= 0.0 && u + v <= 1.0 && t >= 0.0;
  return inside ? t : kMiss;
}

}  // namespace

Projection::Projection(const Eigen::Matrix4d& clip_from_world, const Vector2d& size_in_pixels,
                       double pixels_per_point)
    : clip_from_world_(clip_from_world),
      world_from_clip_(clip_from_world.inverse()),
      size_(size_in_pixels),
      pixels_per_point_(pixels_per_point) {}

std::optional<Vector2d> Projection::to_pixel(const Vector3d& point) const {
  const Vector4d clip = clip_from_world_ * point.homogeneous();
  if (!(clip.w() > 0.0)) return std::nullopt;
  const Vector2d across = clip.head<2>() / clip.w();
  return Vector2d(0.5 * (across + Vector2d::Ones()).cwiseProduct(size_));
}

Ray Projection::ray_through(const Vector2d& pixel) const {
  const Vector2d across = 2.0 * pixel.cwiseQuotient(size_) - Vector2d::Ones();
  const Vector4d near = world_from_clip_ * Vector4d(across.x(), across.y(), kNear, 1.0);
  const Vector4d far = world_from_clip_ * Vector4d(across.x(), across.y(), kFar, 1.0);
  const Vector3d origin = near.hnormalized();
  return {origin, (far.hnormalized() - origin).normalized()};
}

Vector3d Projection::toward_eye(const Vector3d& point) const {
  const auto pixel = to_pixel(point);
  return -ray_through(pixel.value_or(0.5 * size_)).direction;
}

double Projection::length_of_pixel(const Vector3d& point) const {
  const auto pixel = to_pixel(point);
  if (!pixel) return 0.0;
  const Ray beside = ray_through(*pixel + Vector2d::UnitX());
  const Vector3d toward = point - beside.origin;
  return (toward - toward.dot(beside.direction) * beside.direction).norm();
}

namespace {

// Returns the first intersection of the ray with a triangle for which `counts` is true.
template <typename Counts>
std::optional<SurfacePoint> first_of(const Topology& topology, std::span<const Vector3d> positions,
                                     const Ray& ray, const Counts& counts) {
  struct Hit {
    double distance = kMiss;
    Index triangle = kNoIndex;
    auto operator<=>(const Hit&) const = default;
  };
  constexpr std::size_t kPerTask = 16384;
  std::vector<Hit> hits((topology.triangles.size() + kPerTask - 1) / kPerTask);
  parallel_for(topology.triangles.size(), kPerTask, [&](std::size_t begin, std::size_t end) {
    Hit& hit = hits[begin / kPerTask];
    for (std::size_t t = begin; t < end; ++t) {
      if (!counts(topology.triangles[t])) continue;
      const double distance = distance_to(topology.triangles[t], positions, ray);
      if (distance < hit.distance) hit = {distance, static_cast<Index>(t)};
    }
  });
  const auto first = std::ranges::min_element(hits);
  if (first == hits.end() || first->triangle == kNoIndex) return std::nullopt;
  return surface_point(topology, positions, first->triangle,
                       ray.origin + first->distance * ray.direction);
}

}  // namespace

SurfacePoint surface_point(const Topology& topology, std::span<const Vector3d> positions,
                           Index triangle, const Vector3d& position) {
  const Index nearest = std::ranges::min(topology.triangles[triangle], {}, [&](Index v) {
    return (positions[v] - position).squaredNorm();
  });
  return {triangle, nearest, position};
}

std::optional<SurfacePoint> pick_triangle(const Topology& topology,
                                          std::span<const Vector3d> positions, Index triangle,
                                          const Ray& ray) {
  const double distance = distance_to(topology.triangles[triangle], positions, ray);
  if (distance == kMiss) return std::nullopt;
  return surface_point(topology, positions, triangle, ray.origin + distance * ray.direction);
}

std::optional<SurfacePoint> pick_surface(const Topology& topology,
                                         std::span<const Vector3d> positions, const Ray& ray) {
  return first_of(topology, positions, ray, [](const Triangle&) { return true; });
}

std::optional<SurfacePoint> pick_beside(const Topology& topology,
                                        std::span<const Vector3d> positions,
                                        std::span<const char> left_out, const Ray& ray) {
  return first_of(topology, positions, ray, [&](const Triangle& corners) {
    return std::ranges::none_of(corners, [&](Index v) { return left_out[v] != 0; });
  });
}

}  // namespace lapwing::viewer
