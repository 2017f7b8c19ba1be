#pragma once

#include <optional>
#include <span>
#include <vector>

#include "lapwing/mesh/closest_point.h"
#include "lapwing/mesh/topology.h"
#include "lapwing/region/vertex_set.h"
#include "lapwing/transplant/bridge.h"

namespace lapwing {

/// Returns the mean length of the edges of `bridge` between both loops. Welded pairs have length 0.
double strip_width(const Bridge& bridge, std::span<const Eigen::Vector3d> host,
                   std::span<const Eigen::Vector3d> part);

/// Returns whether the strip needs no remeshing: few of its triangles are slivers, and its width is
/// not much larger than the loops' edge lengths.
bool is_even(const Bridge& bridge, std::span<const Eigen::Vector3d> host,
             std::span<const Eigen::Vector3d> part);

/// The sizing field around a seam between two meshes of different scales (paper section 6). The
/// edge length changes from that of the host at the seam to that of the part at the end of the
/// transition.
class SeamSizingField {
 public:
  /// `host_vertices` and `depths` are as in TransplantJoined; `width` is the width of the
  /// transition.
  SeamSizingField(std::span<const Eigen::Vector3d> positions, const Topology& topology,
                  std::span<const Index> host_vertices, std::span<const double> depths,
                  double width);

  /// Returns the vertices of the strip and of the transition on the part, including both loops.
  const VertexSet& region() const { return region_; }

  /// Returns whether the edge lengths of host and part differ by more than the factor kScaleRatio.
  bool asks_for_remeshing() const;

  /// Returns the estimated number of triangles in the region after remeshing.
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
