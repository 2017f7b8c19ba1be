#pragma once

#include <optional>
#include <span>
#include <vector>

#include "lapwing/closest/closest_point.h"
#include "lapwing/mesh/topology.h"
#include "lapwing/region/vertex_set.h"
#include "lapwing/transplant/zip.h"

namespace lapwing {

/// The mean distance between two loops along the edges of `zip`; 0 where all of it is welded.
double strip_width(const Zip& zip, std::span<const Eigen::Vector3d> host,
                   std::span<const Eigen::Vector3d> part);

/// Whether the strip's triangles may stay: few are slivers, and it is not much wider than the
/// loops' edges are long.
bool is_even(const Zip& zip, std::span<const Eigen::Vector3d> host,
             std::span<const Eigen::Vector3d> part);

/// How long edges should be around a seam between two meshes of different scales (paper section 6):
/// from the host's at its rim to the part's own at the transition's inner end.
class SeamLengths {
 public:
  /// `host_vertices` and `depths` as in TransplantJoined; `width` of the transition.
  SeamLengths(std::span<const Eigen::Vector3d> positions, const Topology& topology,
              std::span<const Index> host_vertices, std::span<const double> depths, double width);

  /// The strip and the part's side of the transition, the loops' vertices included.
  const VertexSet& region() const { return region_; }

  /// Whether the edges of host and part differ by more than kScaleRatio.
  bool asks_for_remeshing() const;

  /// About how many triangles remeshing the region to these lengths makes.
  double expected_triangles(std::span<const Eigen::Vector3d> positions) const;

  /// The edge length wanted near `point`.
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
