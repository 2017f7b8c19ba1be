#include "lapwing/mesh/triangle_sides.h"

#include <algorithm>
#include <cstdint>

#include "lapwing/base/cancellation.h"

namespace lapwing {

Adjacency sides_by_edge(std::span<const Triangle> triangles, std::size_t vertex_count) {
  const auto side_count = static_cast<Index>(3 * triangles.size());
  // Counting sort by the lower end, then a sort by the other end and the side's number.
  std::vector<Index> starts(vertex_count + 1, 0);
  const auto ends = [&](Index side) {
    return std::minmax({side_start(triangles, side), side_end(triangles, side)});
  };
  for (Index side = 0; side < side_count; ++side) ++starts[ends(side).first + 1];
  for (std::size_t v = 0; v < vertex_count; ++v) starts[v + 1] += starts[v];
  std::vector<std::uint64_t> sorted(side_count);
  std::vector<Index> next(starts.begin(), starts.end() - 1);
  for (Index side = 0; side < side_count; ++side) {
    const auto [low, high] = ends(side);
    sorted[next[low]++] = std::uint64_t{high} << 32 | side;
  }
  Adjacency edges;
  edges.starts.reserve(side_count / 2 + 2);
  edges.values.reserve(side_count);
  CancelCheck cancel_check;
  for (std::size_t v = 0; v < vertex_count; ++v) {
    cancel_check();
    std::sort(sorted.begin() + starts[v], sorted.begin() + starts[v + 1]);
    for (Index at = starts[v]; at < starts[v + 1]; ++at) {
      if (at > starts[v] && sorted[at] >> 32 != sorted[at - 1] >> 32) edges.starts.push_back(at);
      edges.values.push_back(static_cast<Index>(sorted[at]));
    }
    if (starts[v + 1] > starts[v]) edges.starts.push_back(starts[v + 1]);
  }
  return edges;
}

}  // namespace lapwing
