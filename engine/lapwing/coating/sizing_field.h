#pragma once

#include <optional>
#include <span>
#include <vector>

#include "lapwing/coating/coating.h"
#include "lapwing/mesh/closest_point.h"

namespace lapwing {

/// The sizing field of a target patch that must represent a source's detail (paper section 5.2,
/// "compatible" tessellations). At each vertex, it is kFineness times the length of the source's
/// edges as mapped to the target; if the vertex coincides with a source vertex, the factor is 1. It
/// never exceeds the target's own edge length.
class SizingField {
 public:
  /// `positions` and `points` have one entry per local index of `target`. The arguments need not
  /// outlive the object.
  SizingField(const Coating& coating, const Patch& target,
              std::span<const Eigen::Vector3d> positions, std::span<const SurfacePoint> points);

  /// Returns whether the target is too coarse: at more than the fraction kCoarseShare of its
  /// vertices, its edges are more than kCoarseRatio times longer than the sizing field.
  bool asks_for_remeshing() const { return too_coarse_; }

  /// Returns the target edge length near `point`. Requires `asks_for_remeshing()`.
  double operator()(const Eigen::Vector3d& point) const;

  /// Returns the estimated number of vertices of the remeshed patch, or 0 if it needs no remeshing.
  double vertex_estimate() const { return vertex_estimate_; }

  /// Increases all lengths by a common factor so that the estimate is at most `count`.
  void limit_vertices(double count);

  /// If the edges were as long as the source's but at other positions, creases would look jagged.
  static constexpr double kFineness = 0.6;
  static constexpr double kCoarseRatio = 1.5;
  static constexpr double kCoarseShare = 0.05;

 private:
  std::vector<Triangle> triangles_;
  std::vector<double> lengths_;  ///< by local index of the patch
  /// Empty if no remeshing is needed, because its construction is the most expensive part.
  std::optional<ClosestPoint> closest_;
  bool too_coarse_ = false;
  double vertex_estimate_ = 0.0;
};

}  // namespace lapwing
