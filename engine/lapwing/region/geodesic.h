#pragma once

#include <functional>
#include <limits>
#include <span>
#include <vector>

#include "lapwing/mesh/topology.h"

namespace lapwing {

inline constexpr double kNoLimit = std::numeric_limits<double>::infinity();

/// Returns the geodesic distance of every vertex to the nearest of `sources`, in the unit of the
/// positions. The distance is infinite if there is no path, if it exceeds `max_distance`, and
/// outside `allowed`.
///
/// Fast marching (Kimmel and Sethian 1998). If both ends of an edge were reached from the same
/// source, the front is a circle around the unfolded source (Novotni and Klein 2002), otherwise a
/// straight line. On a flat mesh of well-shaped triangles, the result is exact up to rounding
/// errors. If the distance of a visited vertex decreases, as at obtuse corners, the vertex is
/// visited again. The result is at most the length of the shortest path along edges, and equal to
/// it if all triangles have zero area. Any number of triangles may share an edge.
///
/// `allowed` is empty or has one entry per vertex; paths use only edges and triangles whose corners
/// are all marked. O(n log n) in the part within `max_distance`, plus the time to clear the result.
/// Throws InputError if a source is not a vertex.
std::vector<double> geodesic_distances(const Topology& topology,
                                       std::span<const Eigen::Vector3d> positions,
                                       std::span<const Index> sources,
                                       double max_distance = kNoLimit,
                                       std::span<const char> allowed = {});

/// Returns the shortest path from `from` to `to` along edges (Dijkstra), including both ends. If
/// both are equal, the path is `from`; if they are not connected, it is empty. Ties are broken
/// deterministically. Explores vertices up to the distance of `to`. Throws InputError if an end is
/// not a vertex.
std::vector<Index> shortest_edge_path(const Topology& topology,
                                      std::span<const Eigen::Vector3d> positions, Index from,
                                      Index to);

/// The vertices that a path search may use and at which it ends.
struct PathSearch {
  std::function<bool(Index)> ends_at;
  std::function<bool(Index)> may_reach;  ///< not called for the starts
};
/// Returns the shortest path from one of `starts` to the nearest vertex that `search.ends_at`
/// accepts.
std::vector<Index> shortest_edge_path(const Adjacency& rings,
                                      std::span<const Eigen::Vector3d> positions,
                                      std::span<const Index> starts, const PathSearch& search);

}  // namespace lapwing
