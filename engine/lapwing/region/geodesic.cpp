#include "lapwing/region/geodesic.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <queue>
#include <string>
#include <unordered_map>
#include <utility>

#include "lapwing/base/cancellation.h"
#include "lapwing/base/errors.h"

namespace lapwing {
namespace {

using Eigen::Vector3d;

// Smallest relative improvement that is accepted. Without this limit, rounding errors could make
// two vertices decrease each other's distance endlessly.
constexpr double kSmallestGain = 1e-12;

// Limit on improvements, per vertex on average. It is far more than surfaces need, and later
// improvements are negligible.
constexpr std::size_t kMostOffers = 100;

// A circular front must advance by at least this fraction of a straight front. On a thin band of
// wide triangles, the bulge of the circle could exceed the height of the band. Because the fraction
// is positive, the distance of a vertex exceeds that of one on which it depends, so values cannot
// decrease each other in a cycle.
constexpr double kLeastAdvance = 0.25;

// The triangle abw in the plane: a is the origin, b is at (length, 0), and w is above the x axis.
struct FlatTriangle {
  double length;
  double w_x;
  double w_y;
};

// The distance of a front at w, and whether its ray to w crosses the edge ab.
struct Arrival {
  double distance = kNoLimit;
  bool crosses_edge = false;
};

// Returns the arrival of a straight front.
Arrival plane_arrival(const FlatTriangle& flat, double distance_a, double distance_b) {
  const double n_x = (distance_b - distance_a) / flat.length;
  if (!(std::abs(n_x) < 1.0)) return {};
  const double n_y = std::sqrt((1.0 - n_x) * (1.0 + n_x));
  const double crossing = flat.w_x - flat.w_y * n_x / n_y;
  return {distance_a + n_x * flat.w_x + n_y * flat.w_y, crossing >= 0.0 && crossing <= flat.length};
}

// Returns the arrival of a circular front. Its centre is the point below ab with the two given
// distances from a and b.
Arrival circle_arrival(const FlatTriangle& flat, double distance_a, double distance_b) {
  const double x =
      0.5 * (flat.length + (distance_a - distance_b) * (distance_a + distance_b) / flat.length);
  const double y_squared = (distance_a - x) * (distance_a + x);
  if (!(y_squared >= 0.0)) return {};
  const double y = -std::sqrt(y_squared);
  const double crossing = x + (flat.w_x - x) * y / (y - flat.w_y);
  return {std::hypot(flat.w_x - x, flat.w_y - y), crossing >= 0.0 && crossing <= flat.length};
}

// Returns the distance at w along a straight line through the triangle abw, or infinity if the
// triangle has zero area or no such line crosses ab.
double distance_through_triangle(const Vector3d& a, const Vector3d& b, const Vector3d& w,
                                 double distance_a, double distance_b, bool same_source) {
  const Vector3d edge = b - a;
  const double length = edge.norm();
  if (!(length > 0.0)) return kNoLimit;
  const double w_x = (w - a).dot(edge) / length;
  const double w_y = (w - a - edge * (w_x / length)).norm();
  if (!(w_y > 0.0)) return kNoLimit;
  const FlatTriangle flat{length, w_x, w_y};
  const Arrival plane = plane_arrival(flat, distance_a, distance_b);
  if (same_source) {
    const Arrival circle = circle_arrival(flat, distance_a, distance_b);
    const double nearer = std::min(distance_a, distance_b);
    if (circle.distance - nearer >= kLeastAdvance * (plane.distance - nearer)) {
      return circle.crosses_edge ? circle.distance : kNoLimit;
    }
  }
  return plane.crosses_edge ? plane.distance : kNoLimit;
}

void require_end(const Topology& topology, Index v) {
  if (v < topology.vertex_count()) return;
  throw InputError("vertex " + std::to_string(v) + " cannot end a path: the mesh has " +
                       std::to_string(topology.vertex_count()) + " vertices (numbered from 0)",
                   {v});
}

struct Reached {
  double distance = std::numeric_limits<double>::infinity();
  Index from = kNoIndex;
};

}  // namespace

GeodesicFront::GeodesicFront(const Topology& topology, std::span<const Vector3d> positions,
                             std::span<const Index> sources, std::span<const char> allowed)
    : topology_(topology),
      positions_(positions),
      allowed_(allowed),
      distances_(topology.vertex_count(), kNoLimit),
      sources_(topology.vertex_count(), kNoIndex),
      offers_left_(kMostOffers * topology.vertex_count()) {
  for (const Index source : sources) {
    if (source >= topology.vertex_count()) {
      throw InputError("vertex " + std::to_string(source) +
                           " cannot be a source of distances: the mesh has " +
                           std::to_string(topology.vertex_count()) + " vertices (numbered from 0)",
                       {source});
    }
    if (is_allowed(source)) offer(source, 0.0, source);
  }
}

void GeodesicFront::march_to(double max_distance) {
  max_distance_ = max_distance;
  for (const Entry& entry : std::exchange(beyond_, {})) queue_.push(entry);
  CancelCheck cancel_check;
  while (!queue_.empty()) {
    cancel_check();
    const auto [distance, v] = queue_.top();
    queue_.pop();
    if (distance > distances_[v]) continue;
    if (distance > max_distance_) beyond_.emplace_back(distance, v);
    for (const Index t : topology_.vertex_triangles[v]) update_triangle(topology_.triangles[t], v);
  }
}

void GeodesicFront::update_triangle(const Triangle& triangle, Index v) {
  const std::size_t at = triangle[0] == v ? 0 : triangle[1] == v ? 1 : 2;
  const Index u = triangle[(at + 1) % 3];
  const Index w = triangle[(at + 2) % 3];
  update_corner(v, u, w);
  update_corner(v, w, u);
}

// Lowers the distance of w if a path along the edge vw, or from the edge vu through the triangle,
// is shorter.
void GeodesicFront::update_corner(Index v, Index u, Index w) {
  if (!is_allowed(w)) return;
  // A front only advances, so it cannot decrease the distance of a vertex that it has passed.
  if (distances_[w] <= std::min(distances_[v], distances_[u])) return;
  double best = distances_[v] + (positions_[w] - positions_[v]).norm();
  Index source = sources_[v];
  if (std::isfinite(distances_[u])) {
    const double through =
        distance_through_triangle(positions_[v], positions_[u], positions_[w], distances_[v],
                                  distances_[u], sources_[v] == sources_[u]);
    if (through < best) {
      best = through;
      if (distances_[u] < distances_[v]) source = sources_[u];
    }
  }
  // Keep one layer of vertices beyond the limit, because triangles across the limit need them.
  if (best > max_distance_ && distances_[v] > max_distance_) return;
  offer(w, best, source);
}

void GeodesicFront::offer(Index v, double distance, Index source) {
  if (!(distance < distances_[v] * (1.0 - kSmallestGain)) || offers_left_ == 0) return;
  --offers_left_;
  if (distances_[v] == kNoLimit) reached_.push_back(v);
  distances_[v] = distance;
  sources_[v] = source;
  queue_.emplace(distance, v);
}

std::vector<double> geodesic_distances(const Topology& topology,
                                       std::span<const Vector3d> positions,
                                       std::span<const Index> sources, double max_distance,
                                       std::span<const char> allowed) {
  GeodesicFront front(topology, positions, sources, allowed);
  front.march_to(max_distance);
  std::vector<double> distances = front.take_distances();
  for (double& distance : distances) {
    if (distance > max_distance) distance = kNoLimit;
  }
  return distances;
}

std::vector<Index> shortest_edge_path(const Topology& topology,
                                      std::span<const Eigen::Vector3d> positions, Index from,
                                      Index to) {
  require_end(topology, from);
  require_end(topology, to);
  return shortest_edge_path(topology.rings, positions, {&from, 1},
                            {[&](Index v) { return v == to; }, [](Index) { return true; }});
}

std::vector<Index> shortest_edge_path(const Adjacency& rings,
                                      std::span<const Eigen::Vector3d> positions,
                                      std::span<const Index> starts, const PathSearch& search) {
  // A map instead of an array, because the paths of a loop are short compared with a large mesh.
  std::unordered_map<Index, Reached> reached;
  using Entry = std::pair<double, Index>;
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> queue;
  const auto offer = [&](Index v, double distance, Index from) {
    Reached& there = reached[v];
    if (!(distance < there.distance)) return;
    there = {distance, from};
    queue.emplace(distance, v);
  };
  for (const Index v : starts) offer(v, 0.0, kNoIndex);
  CancelCheck cancel_check;
  while (!queue.empty()) {
    cancel_check();
    const auto [distance, v] = queue.top();
    queue.pop();
    if (distance > reached[v].distance) continue;
    if (search.ends_at(v)) {
      std::vector<Index> path;
      for (Index at = v; at != kNoIndex; at = reached[at].from) path.push_back(at);
      std::reverse(path.begin(), path.end());
      return path;
    }
    for (const Index w : rings[v]) {
      if (search.may_reach(w)) offer(w, distance + (positions[w] - positions[v]).norm(), v);
    }
  }
  return {};
}

}  // namespace lapwing
