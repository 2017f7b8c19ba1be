#pragma once

#include <span>
#include <vector>

#include <Eigen/Core>

#include "lapwing/mesh/topology.h"

namespace lapwing {

/// A request to move `vertex` of a planar triangulation to `target`.
struct PointPull {
  Index vertex = 0;
  Eigen::Vector2d target = Eigen::Vector2d::Zero();
};

struct WarpReport {
  int steps = 0;  ///< number of radial basis steps
  /// Iterations of the constrained parameterization after the radial basis steps, including
  /// attempts to satisfy impossible pulls.
  int constrained_steps = 0;
  std::vector<double> distances;  ///< per pull: final distance of the vertex from its target
  /// Indices, ascending, of pulls that cannot be satisfied without a fold: their vertices are
  /// farther from the targets than 1e-6 of the domain's size. If pulls contradict each other (equal
  /// targets, or they alone flip a triangle), only these are listed, otherwise the pulls that were
  /// farthest from their targets.
  std::vector<Index> unmet;
};

struct WarpResult {
  std::vector<Eigen::Vector2d> points;
  WarpReport report;
};

/// Moves the inner vertices of a bijective planar triangulation so that every pulled vertex reaches
/// its target. The boundary remains fixed and the triangulation bijective. Uses radial basis fields
/// in small steps. If these would flip triangles, a constrained parameterization continues, whose
/// symmetric Dirichlet energy prevents flips. Pulls that cannot be satisfied are listed in `unmet`.
/// Deterministic. O(n k + k^3) per step for k pulls. `boundary` is the boundary loop, on a circle
/// or an axis-aligned rectangle. Pulls must have distinct inner vertices and targets inside the
/// boundary. Otherwise throws InputError, which names the pull and the vertex.
WarpResult warp_domain(std::span<const Triangle> triangles, std::span<const Index> boundary,
                       std::span<const Eigen::Vector2d> points, std::span<const PointPull> pulls);

}  // namespace lapwing
