#include "lapwing/mesh/incident_edges.h"

#include <algorithm>
#include <array>

namespace lapwing {

std::vector<IncidentEdge> incident_edges(Index v, std::span<const Index> around,
                                         std::span<const Triangle> triangles) {
  std::vector<IncidentEdge> ends;
  ends.reserve(2 * around.size());
  for (const Index t : around) {
    ends.push_back({next_corner(triangles[t], v), 1, 0});
    ends.push_back({last_corner(triangles[t], v), 0, 1});
  }
  std::sort(ends.begin(), ends.end(),
            [](const IncidentEdge& a, const IncidentEdge& b) { return a.to < b.to; });
  std::vector<IncidentEdge> spokes;
  spokes.reserve(ends.size());
  for (const IncidentEdge& end : ends) {
    if (spokes.empty() || spokes.back().to != end.to) spokes.push_back({end.to});
    spokes.back().as_next += end.as_next;
    spokes.back().as_last += end.as_last;
  }
  return spokes;
}

bool has_plain_spokes(Index v, std::span<const Index> around, std::span<const Triangle> triangles) {
  constexpr std::size_t kMost = 16;
  if (around.size() > kMost) return false;
  std::array<Index, kMost> next{};
  std::array<Index, kMost> last{};
  for (std::size_t k = 0; k < around.size(); ++k) {
    next[k] = next_corner(triangles[around[k]], v);
    last[k] = last_corner(triangles[around[k]], v);
  }
  const auto count = [&](const auto& list, Index w) {
    return std::count(list.begin(), list.begin() + static_cast<std::ptrdiff_t>(around.size()), w);
  };
  for (std::size_t k = 0; k < around.size(); ++k) {
    if (count(next, next[k]) != 1 || count(last, next[k]) != 1) return false;
  }
  return true;
}

}  // namespace lapwing
