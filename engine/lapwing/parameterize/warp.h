#pragma once

#include <span>
#include <vector>

#include <Eigen/Core>

#include "lapwing/mesh/topology.h"

namespace lapwing {

/// Vertex `vertex` of a planar triangulation should come to `target`.
struct PointPull {
  Index vertex = 0;
  Eigen::Vector2d target = Eigen::Vector2d::Zero();
};

/// What a warp did.
struct WarpReport {
  int steps = 0;  ///< radial-basis steps on the way to the result
  /// Iterations of the constrained parameterization, where steps folded; with those of attempts to
  /// meet more pulls than could be met.
  int constrained_steps = 0;
  std::vector<double> distances;  ///< per pull: how far its vertex is from its target at the end
  /// Pulls that could not be met without a fold, ascending: farther from their targets than 1e-6 of
  /// the domain's size. As few as explain it where that is plain: pulls with one target, pulls that
  /// turn a triangle over by themselves, else those that stayed farthest behind.
  std::vector<Index> unmet;
};

struct WarpResult {
  std::vector<Eigen::Vector2d> points;
  WarpReport report;
};

/// Moves the inner vertices of a bijective planar triangulation so that every pull is met, by a
/// radial-basis elastic warp that leaves the boundary alone, and keeps it bijective: a step that
/// would turn a triangle over is taken as several smaller ones, each from where the last one ended;
/// where steps cannot go on, a constrained parameterization (symmetric Dirichlet energy, whose
/// barrier no triangle passes) pulls the rest of the way. Pulls that contradict each other end up
/// in `unmet`; what is returned is bijective all the same. Deterministic. `boundary` is the
/// boundary loop, on a circle or on a rectangle along the axes. Pulls must name distinct inner
/// vertices and targets inside the boundary. O(n k + k^3) per step for k pulls. Throws InputError,
/// naming pull and vertex by the numbers given, where any of this does not hold.
WarpResult warp_domain(std::span<const Triangle> triangles, std::span<const Index> boundary,
                       std::span<const Eigen::Vector2d> points, std::span<const PointPull> pulls);

}  // namespace lapwing
