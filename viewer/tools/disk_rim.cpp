#include "tools/disk_rim.h"

#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include <Eigen/Geometry>

namespace lapwing::viewer {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr std::size_t kGripCount = 8;
constexpr double kGripReachPt = 8.0;

Vector3d normal_of(const Triangle& t, std::span<const Vector3d> positions) {
  const Vector3d ab = positions[t[1]] - positions[t[0]];
  return ab.cross(positions[t[2]] - positions[t[0]]).stableNormalized();
}

// Returns two perpendicular unit tangents of the surface at a vertex.
std::array<Vector3d, 2> directions_at(Index vertex, const Topology& topology,
                                      std::span<const Vector3d> positions) {
  Vector3d normal = Vector3d::Zero();
  for (const Index t : topology.vertex_triangles[vertex]) {
    normal += normal_of(topology.triangles[t], positions);
  }
  if (normal.squaredNorm() == 0.0) normal = Vector3d::UnitZ();
  const Vector3d across = normal.unitOrthogonal();
  return {across, normal.cross(across).normalized()};
}

}  // namespace

std::vector<RimGrip> rim_grips(const Topology& topology, std::span<const Vector3d> positions,
                               std::span<const double> distances, Index center, double radius) {
  const auto [across, up] = directions_at(center, topology, positions);
  struct Sector {
    double off = std::numeric_limits<double>::infinity();  // angle from its middle, in sectors
    RimGrip grip;
  };
  std::array<Sector, kGripCount> sectors;
  for (const Triangle& t : topology.triangles) {
    for (std::size_t k = 0; k < 3; ++k) {
      const Index a = t[k];
      const Index b = t[(k + 1) % 3];
      if ((distances[a] <= radius) == (distances[b] <= radius)) continue;
      if (!std::isfinite(distances[a]) || !std::isfinite(distances[b])) continue;
      const double share = (radius - distances[a]) / (distances[b] - distances[a]);
      const Vector3d place = positions[a] + share * (positions[b] - positions[a]);
      const Vector3d from_center = place - positions[center];
      const double turn =
          std::atan2(from_center.dot(up), from_center.dot(across)) / (2.0 * std::numbers::pi);
      const double at = (turn < 0.0 ? turn + 1.0 : turn) * kGripCount;
      const double nearest = std::round(at);
      Sector& sector = sectors[static_cast<std::size_t>(nearest) % kGripCount];
      if (std::abs(at - nearest) >= sector.off) continue;
      sector = {std::abs(at - nearest), {place, normal_of(t, positions)}};
    }
  }
  std::vector<RimGrip> grips;
  for (const Sector& sector : sectors) {
    if (std::isfinite(sector.off)) grips.push_back(sector.grip);
  }
  return grips;
}

std::optional<std::size_t> grip_at(std::span<const RimGrip> grips, const Vector2d& pixel,
                                   const Projection& projection) {
  std::optional<std::size_t> nearest;
  double least = projection.in_pixels(kGripReachPt);
  for (std::size_t k = 0; k < grips.size(); ++k) {
    if (!grips[k].faces_eye(projection)) continue;
    const auto place = projection.to_pixel(grips[k].position);
    if (!place || (*place - pixel).norm() >= least) continue;
    least = (*place - pixel).norm();
    nearest = k;
  }
  return nearest;
}

}  // namespace lapwing::viewer
