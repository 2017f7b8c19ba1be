#include "lapwing/mesh/seams.h"

#include <algorithm>
#include <array>
#include <utility>

#include "lapwing/base/union_find.h"

namespace lapwing {

Adjacency find_seams(const Mesh& mesh, const Edges& edges,
                     const std::vector<Index>& first_at_position) {
  using Place = std::pair<Index, Index>;
  std::vector<std::pair<Place, Index>> boundary;
  for (std::size_t e = 0; e < edges.count(); ++e) {
    if (!edges.is_boundary(e)) continue;
    const auto [a, b] = edges.ends[e];
    if (!mesh.positions[a].allFinite() || !mesh.positions[b].allFinite()) continue;
    const auto [low, high] = std::minmax(first_at_position[a], first_at_position[b]);
    if (low != high) boundary.push_back({{low, high}, static_cast<Index>(e)});
  }
  std::ranges::sort(boundary);
  Adjacency seams;
  for (std::size_t i = 0; i < boundary.size();) {
    std::size_t end = i + 1;
    while (end < boundary.size() && boundary[end].first == boundary[i].first) ++end;
    if (end - i > 1) {
      for (; i < end; ++i) seams.values.push_back(boundary[i].second);
      seams.starts.push_back(static_cast<Index>(seams.values.size()));
    }
    i = end;
  }
  return seams;
}

std::vector<Index> joined_at_seams(const Adjacency& seams, const Edges& edges,
                                   const std::vector<Index>& first_at_position) {
  UnionFind joined(first_at_position.size());
  for (std::size_t s = 0; s < seams.row_count(); ++s) {
    const auto [a, b] = edges.ends[seams[s][0]];
    for (const Index edge : seams[s].subspan(1)) {
      auto [c, d] = edges.ends[edge];
      if (first_at_position[c] != first_at_position[a]) std::swap(c, d);
      joined.unite(a, c);
      joined.unite(b, d);
    }
  }
  std::vector<Index> leaders(first_at_position.size());
  for (Index v = 0; v < leaders.size(); ++v) leaders[v] = joined.find(v);
  return leaders;
}

}  // namespace lapwing
