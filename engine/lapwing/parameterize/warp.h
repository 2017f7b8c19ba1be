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
  int steps = 0;  ///< radial-basis steps that were taken
  int constrained_steps =
      0;  ///< iterations of the constrained parameterization, where steps folded
  std::vector<double> distances;  ///< per pull: how far its vertex is from its target at the end
  std::vector<Index> unmet;       ///< pulls that could not be met without a fold, ascending
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
/// boundary loop. Pulls must name distinct inner vertices and targets inside the boundary.
WarpResult warp_domain(std::span<const Triangle> triangles, std::span<const Index> boundary,
                       std::span<const Eigen::Vector2d> points, std::span<const PointPull> pulls);

}  // namespace lapwing
