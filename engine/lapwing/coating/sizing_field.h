#pragma once

#include <optional>
#include <span>
#include <vector>

#include "lapwing/coating/coating.h"
#include "lapwing/mesh/closest_point.h"

namespace lapwing {

/// The sizing field of a target patch that must carry a source's detail (paper section 5.2,
/// "compatible" tessellations). At each vertex it is kFineness times the length of the source's
/// edges as mapped to the target, or all of their length on a vertex of the source. It never
/// exceeds the target's own edge length.
class SizingField {
 public:
  /// `positions` and `points` are per own number of `target`. Copies what it needs.
  SizingField(const Coating& coating, const Patch& target,
              std::span<const Eigen::Vector3d> positions, std::span<const SurfacePoint> points);

  /// Returns whether the target is too coarse: at more than kCoarseShare of its vertices, its edges
  /// are more than kCoarseRatio times as long as they should be.
  bool asks_for_remeshing() const { return too_coarse_; }

  /// Returns the target edge length near `point`. Requires `asks_for_remeshing()`.
  double operator()(const Eigen::Vector3d& point) const;

  /// Estimates the vertices of the remeshed patch; 0 if it needs no remeshing.
  double vertex_estimate() const { return vertex_estimate_; }

  /// Scales up all lengths so that the estimate is at most `count`.
  void limit_vertices(double count);

  /// Edges as long as the source's, but at other places, cut its creases into teeth.
  static constexpr double kFineness = 0.6;
  static constexpr double kCoarseRatio = 1.5;
  static constexpr double kCoarseShare = 0.05;

 private:
  std::vector<Triangle> triangles_;
  std::vector<double> lengths_;  ///< per own number of the patch
  /// Empty if no remeshing is needed, since it costs more than all the rest.
  std::optional<ClosestPoint> closest_;
  bool too_coarse_ = false;
  double vertex_estimate_ = 0.0;
};

}  // namespace lapwing
