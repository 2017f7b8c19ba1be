#pragma once

#include <span>
#include <vector>

#include <Eigen/Core>

#include "lapwing/parameterize/domain_chart.h"
#include "lapwing/parameterize/warp.h"

namespace lapwing {

/// The data of a domain that do not change while its points move.
struct WarpedDomain {
  std::span<const Triangle> triangles;
  DomainChart chart;
  std::vector<char> is_held;  ///< per vertex: whether it is on the boundary or in no triangle
  double extent = 1.0;        ///< the result of `extent`
};

/// The paths of pulled vertices to their targets: straight lines or arcs. An arc is a straight line
/// in a frame that rotates by the best-fit angle of all pulls. If two vertices swap positions,
/// straight paths collide in the middle, but arcs do not.
enum class PullWays { straight, arcs };

/// Moves `points` towards the targets of the pulls by a sequence of radial basis fields. Each step
/// moves along 1 / n of the remaining path, with n so large that every triangle keeps half of its
/// area. The composition approximates a flow, so it can satisfy pulls for which a single field
/// would fold. Stops when all pulled vertices are exactly on their targets, after `most_steps`
/// steps, or if n would exceed `most_steps`. Remains bijective. Returns the number of steps.
int step_elastically(const WarpedDomain& domain, std::span<const PointPull> pulls, PullWays ways,
                     int most_steps, std::vector<Eigen::Vector2d>& points);

double largest_distance(std::span<const PointPull> pulls, std::span<const Eigen::Vector2d> points);

}  // namespace lapwing
