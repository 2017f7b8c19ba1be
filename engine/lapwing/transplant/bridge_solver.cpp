#include "lapwing/transplant/bridge_solver.h"

#include <algorithm>

#include <Eigen/Geometry>

namespace lapwing::bridging {
namespace {

using Eigen::Vector3d;

// Returns the number of edges from one position in a loop to another; `size` if both are equal.
std::size_t edges_between(std::size_t from, std::size_t to, std::size_t size) {
  return to > from ? to - from : to + size - from;
}

Vector3d normal_behind(const BridgeLoop& loop, std::size_t k) {
  if (loop.across.empty()) return Vector3d::Zero();
  const Vector3d& from = loop.points[k];
  const Vector3d& to = loop.points[(k + 1) % loop.points.size()];
  return (to - from).cross(loop.across[k] - from).normalized();
}

// Returns the vertex at about half of the loop's length from `first`, but never `first` itself.
std::size_t half_way(const RimLoop& loop, std::size_t first) {
  const Chain around = loop.chain(first, loop.size());
  std::vector<double> length{0.0};
  for (std::size_t k = 0; k < loop.size(); ++k) {
    length.push_back(length.back() + (around.points[k + 1] - around.points[k]).norm());
  }
  const auto half = std::ranges::lower_bound(length, 0.5 * length.back()) - length.begin();
  const auto steps = std::clamp<std::size_t>(static_cast<std::size_t>(half), 1, loop.size() - 1);
  return (first + steps) % loop.size();
}

}  // namespace

RimLoop::RimLoop(const BridgeLoop& loop, bool backwards) : backwards_(backwards) {
  const std::size_t count = loop.points.size();
  points_.resize(count);
  normals_.resize(count);
  for (std::size_t k = 0; k < count; ++k) {
    points_[k] = loop.points[original(k)];
    normals_[k] = normal_behind(loop, backwards ? count - 1 - k : k);
  }
  const auto add = [&](std::size_t a, std::size_t b) {
    edges_.push_back({static_cast<Index>(std::min(a, b)), static_cast<Index>(std::max(a, b))});
  };
  for (std::size_t k = 0; k < count; ++k) add(k, (k + 1) % count);
  for (const auto& [a, b] : loop.chords) add(original(a), original(b));
  std::ranges::sort(edges_);
}

bool RimLoop::has_edge(std::size_t a, std::size_t b) const {
  const std::array<Index, 2> edge{static_cast<Index>(std::min(a, b)),
                                  static_cast<Index>(std::max(a, b))};
  return std::ranges::binary_search(edges_, edge);
}

// The reversal is its own inverse.
Index RimLoop::original(std::size_t place) const {
  return static_cast<Index>(backwards_ ? (size() - place) % size() : place);
}

Chain RimLoop::chain(std::size_t first, std::size_t count) const {
  Chain chain;
  for (std::size_t k = 0; k <= count; ++k) {
    chain.points.push_back(points_[(first + k) % size()]);
    if (k < count) chain.normals.push_back(normals_[(first + k) % size()]);
  }
  return chain;
}

Gap BridgeSolver::gap_after(const std::vector<Node>& nodes, std::size_t k) const {
  const Node& start = nodes[k];
  const Node& end = nodes[(k + 1) % nodes.size()];
  Gap gap;
  gap.host = host_.chain(start.host, edges_between(start.host, end.host, host_.size()));
  gap.part = part_.chain(start.part, edges_between(start.part, end.part, part_.size()));
  gap.starts_welded = start.welded;
  gap.ends_welded = end.welded;
  gap.closed = nodes.size() == 1 && !start.welded;
  if (start.welded || end.welded) forbid_repeated_edges(gap, start, end);
  // With two nodes, both gaps could contain the same edge between the loops, so it is forbidden in
  // both.
  if (nodes.size() == 2 && gap.host.edge_count() + gap.part.edge_count() > 2) {
    gap.no_rung_to_part_start.resize(gap.host.points.size());
    gap.no_rung_to_part_start.back() = 1;
    gap.no_rung_to_host_start.resize(gap.part.points.size());
    gap.no_rung_to_host_start.back() = 1;
  }
  return gap;
}

// A rung at a welded vertex joins two vertices of one loop. If an edge already joins them, the rung
// would repeat it, unless it is the loop edge at the end of the gap.
void BridgeSolver::forbid_repeated_edges(Gap& gap, const Node& start, const Node& end) const {
  const std::size_t a = gap.host.edge_count();
  const std::size_t b = gap.part.edge_count();
  const bool joined_by_host =
      start.host == end.host || (a > 1 && host_.has_edge(start.host, end.host));
  const bool joined_by_part =
      start.part == end.part || (b > 1 && part_.has_edge(start.part, end.part));
  const bool both = start.welded && end.welded;

  // Returns, for each vertex of `loop` from `first` on, whether an edge already joins it to the
  // welded end of the chain.
  const auto joined = [](const RimLoop& loop, std::size_t first, std::size_t edges, bool to_end) {
    std::vector<char> list(edges + 1, 0);
    const std::size_t welded = (first + (to_end ? edges : 0)) % loop.size();
    for (std::size_t k = 0; k <= edges; ++k) {
      const std::size_t apart = to_end ? edges - k : k;
      const std::size_t place = (first + k) % loop.size();
      list[k] = apart > 1 && (place == welded || loop.has_edge(place, welded)) ? 1 : 0;
    }
    return list;
  };
  if (start.welded) {
    gap.no_rung_to_part_start = joined(host_, start.host, a, false);
    gap.no_rung_to_host_start = joined(part_, start.part, b, false);
    if (both && joined_by_part) gap.no_rung_to_part_start.back() = 1;
    if (both && joined_by_host) gap.no_rung_to_host_start.back() = 1;
  }
  if (end.welded) {
    gap.no_rung_to_part_end = joined(host_, start.host, a, true);
    gap.no_rung_to_host_end = joined(part_, start.part, b, true);
    if (both && joined_by_part) gap.no_rung_to_part_end.front() = 1;
    if (both && joined_by_host) gap.no_rung_to_host_end.front() = 1;
  }
}

BridgeStrip BridgeSolver::solve(std::vector<Node> nodes) const {
  BridgeStrip strip;
  strip.nodes = std::move(nodes);
  for (std::size_t k = 0; k < strip.nodes.size(); ++k) {
    const BridgePath path = shortest_bridge(gap_after(strip.nodes, k));
    if (path.steps.empty()) strip.blocked.push_back(k);
    strip.steps.insert(strip.steps.end(), path.steps.begin(), path.steps.end());
    strip.cost += path.cost;
  }
  return strip;
}

BridgeStrip BridgeSolver::solve_with_second_rung(const Node& node) const {
  const Node second{static_cast<Index>(half_way(host_, node.host)),
                    static_cast<Index>(half_way(part_, node.part)), false};
  return solve({node, second});
}

std::vector<Triangle> BridgeSolver::triangles(const BridgeStrip& strip) const {
  std::vector<Index> host_of_part(part_.size(), kNoIndex);
  for (const Node& node : strip.nodes) {
    if (node.welded) host_of_part[node.part] = node.host;
  }
  const auto on_host = [&](std::size_t i) { return static_cast<Index>(i % host_.size()); };
  const auto on_part = [&](std::size_t j) {
    const Index welded = host_of_part[j % part_.size()];
    const auto offset = static_cast<Index>(host_.size());
    return welded != kNoIndex ? welded : offset + part_.original(j % part_.size());
  };
  std::vector<Triangle> triangles;
  std::size_t i = strip.nodes[0].host;
  std::size_t j = strip.nodes[0].part;
  for (const Step step : strip.steps) {
    const Triangle triangle = step == Step::host ? Triangle{on_host(i + 1), on_host(i), on_part(j)}
                                                 : Triangle{on_part(j), on_part(j + 1), on_host(i)};
    ++(step == Step::host ? i : j);
    const bool at_weld = triangle[2] == triangle[0] || triangle[2] == triangle[1];
    if (!at_weld) triangles.push_back(triangle);
  }
  return triangles;
}

}  // namespace lapwing::bridging
