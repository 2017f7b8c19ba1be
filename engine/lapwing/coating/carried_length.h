#pragma once

#include <optional>
#include <span>
#include <vector>

#include "lapwing/closest/closest_point.h"
#include "lapwing/coating/patch_coating.h"
#include "lapwing/mesh/surface_point.h"

namespace lapwing {

/// How fine a target patch must be to carry what comes to it from a source (paper section 5.2,
/// "compatible" tessellations): per vertex kFineness times the source's edges as they are laid onto
/// the target, all of their length where the vertex lies on one of the source's, but never longer
/// than the target's own.
class CarriedLength {
 public:
  /// `positions` and `points` per own number of `target`; copies what it needs.
  CarriedLength(const Coating& coating, const Patch& target,
                std::span<const Eigen::Vector3d> positions, std::span<const SurfacePoint> points);

  /// Whether the target is too coarse: its edges are more than kCoarseRatio times as long as they
  /// should be at more than kCoarseShare of its vertices.
  bool asks_for_remeshing() const { return too_coarse_; }

  /// The edge length wanted near `point` of a target that asks for remeshing.
  double operator()(const Eigen::Vector3d& point) const;

  /// About how many vertices the patch has with these edges; 0 where it does not ask for remeshing.
  double vertex_estimate() const { return vertex_estimate_; }

  /// Makes all lengths longer so that the estimate is at most `count`.
  void limit_vertices(double count);

  /// Edges as long as the source's, but elsewhere than they are, cut its creases into teeth.
  static constexpr double kFineness = 0.6;
  static constexpr double kCoarseRatio = 1.5;
  static constexpr double kCoarseShare = 0.05;

 private:
  std::vector<Triangle> triangles_;
  std::vector<double> lengths_;  ///< per own number
  /// None where nothing asks for remeshing: it costs more than all the rest.
  std::optional<ClosestPoint> closest_;
  bool too_coarse_ = false;
  double vertex_estimate_ = 0.0;
};

}  // namespace lapwing
