#pragma once

#include <optional>
#include <span>
#include <vector>

#include "lapwing/mesh/closest_point.h"
#include "lapwing/mesh/topology.h"
#include "lapwing/region/vertex_set.h"
#include "lapwing/transplant/bridge.h"

namespace lapwing {

/// Returns the mean distance between two loops along the edges of `bridge`; welded pairs count as
/// 0.
double strip_width(const Bridge& bridge, std::span<const Eigen::Vector3d> host,
                   std::span<const Eigen::Vector3d> part);

/// Returns whether the strip's triangles may stay: few are slivers, and the strip is not much wider
/// than the loops' edges are long.
bool is_even(const Bridge& bridge, std::span<const Eigen::Vector3d> host,
             std::span<const Eigen::Vector3d> part);

/// The sizing field around a seam between two meshes of different scales (paper section 6). It goes
/// from the host's edge length at its rim to the part's own at the transition's inner end.
class SeamSizingField {
 public:
  /// `host_vertices` and `depths` are as in TransplantJoined, `width` is that of the transition.
  SeamSizingField(std::span<const Eigen::Vector3d> positions, const Topology& topology,
                  std::span<const Index> host_vertices, std::span<const double> depths,
                  double width);

  /// The vertices of the strip and of the part's side of the transition, both loops included.
  const VertexSet& region() const { return region_; }

  /// Returns whether the edge lengths of host and part differ by a factor above kScaleRatio.
  bool asks_for_remeshing() const;

  /// Estimates the number of triangles in the region after remeshing it to these lengths.
  double expected_triangles(std::span<const Eigen::Vector3d> positions) const;

  /// Returns the target edge length near `point`.
  double operator()(const Eigen::Vector3d& point) const;

  static constexpr double kScaleRatio = 1.6;

 private:
  VertexSet region_;
  double host_length_ = 0.0;
  double part_length_ = 0.0;
  std::vector<Triangle> triangles_;
  std::vector<double> lengths_;  ///< per vertex
  std::optional<ClosestPoint> closest_;
};

}  // namespace lapwing
