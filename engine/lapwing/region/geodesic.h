#pragma once

#include <limits>
#include <span>
#include <vector>

#include "lapwing/mesh/topology.h"

namespace lapwing {

inline constexpr double kNoLimit = std::numeric_limits<double>::infinity();

/// Geodesic distance of every vertex to the nearest of `sources`, in the unit of the positions;
/// infinity where no path leads, beyond `max_distance`, and off `allowed`.
///
/// Fast marching (Kimmel and Sethian 1998). Where both ends of an edge were reached from one source
/// the front is the circle that they unfold to (Novotni and Klein 2002), which makes a flat mesh of
/// well-shaped triangles exact to rounding; elsewhere it is a straight line. A vertex whose
/// distance falls after it was passed, as happens at obtuse corners, is passed again. Never larger
/// than the shortest path along edges, and equal to it where triangles have no area; any number of
/// triangles may share an edge.
///
/// `allowed`, when not empty, has one entry per vertex: paths keep to edges and triangles whose
/// corners are all marked. O(n log n), and proportional to the part within `max_distance` beside
/// clearing the result. Throws InputError when a source is not a vertex.
std::vector<double> geodesic_distances(const Topology& topology,
                                       std::span<const Eigen::Vector3d> positions,
                                       std::span<const Index> sources,
                                       double max_distance = kNoLimit,
                                       std::span<const char> allowed = {});

}  // namespace lapwing
