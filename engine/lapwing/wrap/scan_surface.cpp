#include "lapwing/wrap/scan_surface.h"

#include <algorithm>
#include <numeric>

#include <Eigen/Geometry>

#include "lapwing/base/parallel.h"
#include "lapwing/region/border_belt.h"

namespace lapwing {
namespace {

using Eigen::Vector3d;

// The cosine of the largest angle between normals of corresponding points, 60 degrees.
constexpr double kAgree = 0.5;

constexpr double kFar = 3.0;

constexpr std::size_t kPointsPerTask = 512;

Vector3d area_vector(const Triangle& t, std::span<const Vector3d> positions) {
  const Vector3d edge = positions[t[1]] - positions[t[0]];
  return 0.5 * edge.cross(positions[t[2]] - positions[t[0]]);
}

}  // namespace

ScanSurface::ScanSurface(const Topology& topology, std::span<const Vector3d> positions)
    : ScanSurface(topology, positions, positions.size()) {}

ScanSurface::ScanSurface(const Topology& topology, std::span<const Vector3d> positions,
                         std::size_t measured)
    : topology_(topology),
      positions_(positions),
      measured_(measured),
      normals_(positions.size(), Vector3d::Zero()),
      areas_(positions.size(), 0.0),
      on_boundary_(positions.size(), 0) {
  for (const Triangle& t : topology.triangles) {
    const Vector3d area = area_vector(t, positions);
    for (const Index v : t) {
      normals_[v] += area;
      areas_[v] += area.norm() / 3.0;
    }
  }
  for (Vector3d& normal : normals_) normal.normalize();
  for (Index v = 0; v < positions.size(); ++v) {
    on_boundary_[v] = on_mesh_boundary(v, topology) ? 1 : 0;
  }
  closest_.emplace(topology.triangles, positions);
}

SurfaceSamples ScanSurface::samples(std::size_t count) const {
  const std::span<const double> areas = std::span(areas_).first(measured_);
  const double step = std::accumulate(areas.begin(), areas.end(), 0.0) / static_cast<double>(count);
  SurfaceSamples samples;
  double next = 0.0;
  double passed = 0.0;
  for (std::size_t v = 0; v < areas.size(); ++v) {
    passed += areas[v];
    if (passed <= next) continue;
    samples.points.push_back(positions_[v]);
    samples.normals.push_back(normals_[v]);
    next = std::max(next + step, passed - step);
  }
  return samples;
}

// Returns whether the point is on an edge or at a vertex of the boundary.
bool ScanSurface::is_on_boundary(const TrianglePoint& point) const {
  constexpr double kOff = 1e-9;
  const Triangle& t = topology_.triangles[point.triangle];
  bool all = true;
  for (std::size_t k = 0; k < 3; ++k) {
    if (point.weights[k] > kOff && on_boundary_[t[k]] == 0) all = false;
  }
  const bool is_inside = std::ranges::all_of(point.weights, [](double w) { return w > kOff; });
  return all && !is_inside;
}

Counterpart ScanSurface::counterpart(const Vector3d& point, const Vector3d& normal,
                                     Index& hint) const {
  const TrianglePoint found = closest_->find(0, point, normal, hint);
  hint = found.hint;
  const Triangle& t = topology_.triangles[found.triangle];
  Counterpart counterpart{{t, found.weights}, found.position, (found.position - point).norm()};
  const Vector3d facing = area_vector(t, positions_).normalized();
  counterpart.agrees = facing.dot(normal) > kAgree && !is_on_boundary(found);
  return counterpart;
}

std::vector<Counterpart> counterparts_of(std::span<const Vector3d> points,
                                         std::span<const Vector3d> normals,
                                         const ScanSurface& surface, std::vector<Index>& hints) {
  hints.resize(points.size(), kNoIndex);
  std::vector<Counterpart> counterparts(points.size());
  parallel_for(points.size(), kPointsPerTask, [&](std::size_t begin, std::size_t end) {
    for (std::size_t k = begin; k < end; ++k) {
      counterparts[k] = surface.counterpart(points[k], normals[k], hints[k]);
    }
  });
  return counterparts;
}

double far_distance(std::span<const Counterpart> counterparts) {
  std::vector<double> distances;
  for (const Counterpart& c : counterparts) {
    if (c.agrees) distances.push_back(c.distance);
  }
  if (distances.empty()) return 0.0;
  const auto middle = distances.begin() + static_cast<std::ptrdiff_t>(distances.size() / 2);
  std::ranges::nth_element(distances, middle);
  return kFar * *middle;
}

std::vector<SurfacePoint> accepted(std::span<const Counterpart> counterparts, double edge) {
  const double far = std::max(edge, far_distance(counterparts));
  std::vector<SurfacePoint> points;
  for (const Counterpart& c : counterparts) {
    points.push_back(c.agrees && c.distance <= far ? c.point : SurfacePoint::nowhere());
  }
  return points;
}

}  // namespace lapwing
