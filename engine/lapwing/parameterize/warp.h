#pragma once

#include <span>
#include <vector>

#include <Eigen/Core>

#include "lapwing/mesh/topology.h"

namespace lapwing {

/// Pulls vertex `vertex` of a planar triangulation to `target`.
struct PointPull {
  Index vertex = 0;
  Eigen::Vector2d target = Eigen::Vector2d::Zero();
};

/// What a warp did.
struct WarpReport {
  int steps = 0;  ///< radial-basis steps on the way to the result
  /// Iterations of the constrained parameterization after steps that folded, including attempts to
  /// meet more pulls than could be met.
  int constrained_steps = 0;
  std::vector<double> distances;  ///< per pull: final distance of its vertex from its target
  /// Pulls that could not be met without a fold, ascending: farther from their targets than 1e-6 of
  /// the domain's size. If the cause is plain, only the pulls that explain it: those with one
  /// target, or that by themselves turn a triangle over. Otherwise those that stayed farthest
  /// behind.
  std::vector<Index> unmet;
};

struct WarpResult {
  std::vector<Eigen::Vector2d> points;
  WarpReport report;
};

/// Moves the inner vertices of a bijective planar triangulation so that every pull is met, by a
/// radial-basis elastic warp that keeps the boundary fixed and the triangulation bijective. A step
/// that would turn a triangle over is divided into smaller ones, each from the end of the last one.
/// If steps cannot go on, a constrained parameterization pulls the rest of the way: no triangle can
/// pass the barrier of its symmetric Dirichlet energy. Pulls that contradict each other end up in
/// `unmet`; the result is bijective all the same. Deterministic. O(n k + k^3) per step for k pulls.
/// `boundary` is the boundary loop, on a circle or an axis-aligned rectangle. Pulls must name
/// distinct inner vertices and targets inside the boundary. Throws InputError, naming pull and
/// vertex by the given numbers, if any of this does not hold.
WarpResult warp_domain(std::span<const Triangle> triangles, std::span<const Index> boundary,
                       std::span<const Eigen::Vector2d> points, std::span<const PointPull> pulls);

}  // namespace lapwing
