#pragma once

#include <span>
#include <vector>

#include <Eigen/Core>

#include "lapwing/parameterize/domain_chart.h"
#include "lapwing/parameterize/warp.h"

namespace lapwing {

/// What stays the same while the points of a domain move.
struct WarpedDomain {
  std::span<const Triangle> triangles;
  DomainChart chart;
  std::vector<char> is_held;  ///< per vertex: on the boundary, or in no triangle
  double extent = 1.0;        ///< see `extent`
};

/// The ways on which pulled vertices go to their targets: straight, or on arcs with the turn that
/// fits all pulls best, straight in the frame that turns along. Two vertices that change places
/// meet half-way on straight ways; on arcs they circle around each other.
enum class PullWays { straight, arcs };

/// Moves `points` towards the pulls along radial-basis fields, each from where the last one ended:
/// the whole way where every triangle keeps a good share of its area, else in even parts as long
/// as that allows. The composition follows a flow, and so gets where one field would fold. Stops
/// when all pulls are met, their vertices then lying on the targets exactly, or when
/// `most_steps` are taken or a step would have to be shorter than 1 / `most_steps` of the rest of
/// the way. Bijective throughout. Returns how many steps were taken.
int step_elastically(const WarpedDomain& domain, std::span<const PointPull> pulls, PullWays ways,
                     int most_steps, std::vector<Eigen::Vector2d>& points);

/// Largest distance of a pulled vertex from its target.
double largest_distance(std::span<const PointPull> pulls, std::span<const Eigen::Vector2d> points);

}  // namespace lapwing
