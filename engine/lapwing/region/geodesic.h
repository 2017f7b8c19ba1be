#pragma once

#include <cstddef>
#include <functional>
#include <limits>
#include <queue>
#include <span>
#include <utility>
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

/// Computes geodesic_distances up to a limit that can be raised. Use it for a search that does not
/// know in advance how far it must go.
class GeodesicFront {
 public:
  /// All arguments must outlive the object. Throws InputError if a source is not a vertex.
  GeodesicFront(const Topology& topology, std::span<const Eigen::Vector3d> positions,
                std::span<const Index> sources, std::span<const char> allowed = {});

  /// Computes the distances up to `max_distance`, which must not decrease from call to call. A
  /// later call visits only the vertices that earlier calls did not reach.
  void march_to(double max_distance);

  /// Returns the distance of each vertex. Those beyond the limit are upper bounds, or infinite.
  std::span<const double> distances() const { return distances_; }
  std::vector<double> take_distances() { return std::move(distances_); }
  /// Returns the vertices whose distance is not infinite, in the order in which they were reached.
  std::span<const Index> reached() const { return reached_; }

 private:
  using Entry = std::pair<double, Index>;

  bool is_allowed(Index v) const { return allowed_.empty() || allowed_[v] != 0; }
  void update_triangle(const Triangle& triangle, Index v);
  void update_corner(Index v, Index u, Index w);
  void offer(Index v, double distance, Index source);

  const Topology& topology_;
  std::span<const Eigen::Vector3d> positions_;
  std::span<const char> allowed_;
  double max_distance_ = 0.0;
  std::vector<double> distances_;
  std::vector<Index> sources_;  // the source whose front reached each vertex
  std::vector<Index> reached_;
  std::size_t offers_left_;
  // Entries are ordered by distance, then by vertex, so that the order of equal distances is
  // deterministic.
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> queue_;
  std::vector<Entry> beyond_;  // entries beyond the limit, to visit again when it is raised
};

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
