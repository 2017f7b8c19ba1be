#pragma once

#include <span>
#include <vector>

#include <Eigen/Core>

#include "lapwing/parameterize/domain_chart.h"
#include "lapwing/parameterize/warp.h"

namespace lapwing {

/// The parts of a domain that stay fixed while its points move.
struct WarpedDomain {
  std::span<const Triangle> triangles;
  DomainChart chart;
  std::vector<char> is_held;  ///< per vertex: on the boundary, or in no triangle
  double extent = 1.0;        ///< the result of `extent`
};

/// The paths of pulled vertices to their targets: straight, or on arcs. An arc is straight in a
/// frame that rotates by the angle that fits all pulls best. Two vertices that change places meet
/// half-way on straight paths; on arcs they circle around each other.
enum class PullWays { straight, arcs };

/// Moves `points` towards the pulls along radial-basis fields, each from the end of the last one. A
/// step goes the whole way if every triangle then keeps a good share of its area, otherwise the
/// largest even part of the way that allows this. The composition follows a flow, so it can meet
/// pulls for which a single field would fold. Stops when all pulls are met, with their vertices
/// exactly on the targets, after `most_steps`, or if a step would be shorter than 1 / `most_steps`
/// of the remaining way. Stays bijective. Returns the number of steps.
int step_elastically(const WarpedDomain& domain, std::span<const PointPull> pulls, PullWays ways,
                     int most_steps, std::vector<Eigen::Vector2d>& points);

/// Returns the largest distance of a pulled vertex from its target.
double largest_distance(std::span<const PointPull> pulls, std::span<const Eigen::Vector2d> points);

}  // namespace lapwing
