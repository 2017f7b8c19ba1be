#include "lapwing/render/closed_surface.h"

#include <algorithm>
#include <cstdint>
#include <vector>

#include <Eigen/Geometry>

#include "lapwing/base/union_find.h"

namespace lapwing {
namespace {

std::uint64_t half_edge(Index from, Index to) {
  return std::uint64_t{from} << 32U | to;
}

bool every_edge_is_shared(std::span<const Triangle> triangles) {
  std::vector<std::uint64_t> edges;
  edges.reserve(3 * triangles.size());
  for (const Triangle& t : triangles) {
    for (std::size_t c = 0; c < 3; ++c) edges.push_back(half_edge(t[c], t[(c + 1) % 3]));
  }
  std::sort(edges.begin(), edges.end());
  if (std::adjacent_find(edges.begin(), edges.end()) != edges.end()) return false;
  return std::all_of(triangles.begin(), triangles.end(), [&](const Triangle& t) {
    return std::binary_search(edges.begin(), edges.end(), half_edge(t[1], t[0])) &&
           std::binary_search(edges.begin(), edges.end(), half_edge(t[2], t[1])) &&
           std::binary_search(edges.begin(), edges.end(), half_edge(t[0], t[2]));
  });
}

}  // namespace

bool is_closed_outward(std::span<const Eigen::Vector3d> positions,
                       std::span<const Triangle> triangles) {
  if (triangles.empty() || !every_edge_is_shared(triangles)) return false;
  UnionFind pieces(positions.size());
  for (const Triangle& t : triangles) {
    pieces.unite(t[0], t[1]);
    pieces.unite(t[0], t[2]);
  }
  // The volume of a closed component does not depend on the reference point; a near one avoids
  // cancellation.
  std::vector<double> volumes(positions.size(), 0.0);
  for (const Triangle& t : triangles) {
    const Index piece = pieces.find(t[0]);
    const Eigen::Vector3d& from = positions[piece];
    volumes[piece] +=
        (positions[t[0]] - from).dot((positions[t[1]] - from).cross(positions[t[2]] - from));
  }
  return std::all_of(triangles.begin(), triangles.end(),
                     [&](const Triangle& t) { return volumes[pieces.find(t[0])] > 0.0; });
}

}  // namespace lapwing
