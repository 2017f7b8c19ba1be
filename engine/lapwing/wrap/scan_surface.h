#pragma once

#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "lapwing/mesh/closest_point.h"
#include "lapwing/mesh/topology.h"

namespace lapwing {

/// The counterpart of a point on another surface.
struct Counterpart {
  SurfacePoint point;
  Eigen::Vector3d position = Eigen::Vector3d::Zero();
  double distance = 0.0;
  bool agrees = false;  ///< the normals agree, and the point is not on the surface's boundary
};

/// Points that are spread evenly over a surface, with its normals.
struct SurfaceSamples {
  Positions points;
  Positions normals;
};

/// A surface that is searched for closest points. Threads may share an object.
class ScanSurface {
 public:
  /// Both arguments must outlive the object. O(n log n).
  ScanSurface(const Topology& topology, std::span<const Eigen::Vector3d> positions);
  /// Only the first `measured` vertices are samples.
  ScanSurface(const Topology& topology, std::span<const Eigen::Vector3d> positions,
              std::size_t measured);

  const Topology& topology() const { return topology_; }
  std::span<const Eigen::Vector3d> positions() const { return positions_; }
  /// Unit normals, weighted by area; zero for a vertex without triangles.
  std::span<const Eigen::Vector3d> normals() const { return normals_; }
  /// A third of the area of the triangles around each vertex.
  std::span<const double> areas() const { return areas_; }

  /// Returns at most `count` of the vertices, spaced evenly by area.
  SurfaceSamples samples(std::size_t count) const;

  /// Returns the closest point to `point`, preferably where the surface faces along `normal`.
  /// `hint` is the triangle of a nearby result, or kNoIndex. It is replaced by the triangle of this
  /// result.
  Counterpart counterpart(const Eigen::Vector3d& point, const Eigen::Vector3d& normal,
                          Index& hint) const;

 private:
  bool is_on_boundary(const TrianglePoint& point) const;

  const Topology& topology_;
  std::span<const Eigen::Vector3d> positions_;
  std::size_t measured_;
  std::vector<Eigen::Vector3d> normals_;
  std::vector<double> areas_;
  std::vector<char> on_boundary_;  // per vertex
  std::optional<ClosestPoint> closest_;
};

/// Returns the counterpart on `surface` of each point with its normal. `hints` contains a hint for
/// each point, or is empty, and is replaced. Uses all CPU cores.
std::vector<Counterpart> counterparts_of(std::span<const Eigen::Vector3d> points,
                                         std::span<const Eigen::Vector3d> normals,
                                         const ScanSurface& surface, std::vector<Index>& hints);

/// Returns the distance above which a pair is much farther apart than the others: three times the
/// median distance of the counterparts that agree; 0 if there is none.
double far_distance(std::span<const Counterpart> counterparts);

/// Returns the counterparts whose normals agree and that are closer than `far_distance` or `edge`.
/// The others are "nowhere".
std::vector<SurfacePoint> accepted(std::span<const Counterpart> counterparts, double edge);

}  // namespace lapwing
