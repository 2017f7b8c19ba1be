#include "lapwing/doctor/seams.h"

#include <algorithm>
#include <array>
#include <utility>

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

}  // namespace lapwing
