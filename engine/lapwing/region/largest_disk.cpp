#include "lapwing/region/largest_disk.h"

#include <algorithm>
#include <functional>
#include <queue>
#include <utility>

#include "lapwing/base/cancellation.h"
#include "lapwing/base/union_find.h"
#include "lapwing/mesh/edges.h"
#include "lapwing/region/disk_report.h"
#include "lapwing/region/geodesic.h"

namespace lapwing {
namespace {

// A disk that grows vertex by vertex.
class Disk {
 public:
  Disk(const Topology& topology, const std::vector<char>& region)
      : topology_(topology), region_(region), joined_(topology.vertex_count(), 0) {}

  void start_with(const Triangle& triangle) {
    for (const Index v : triangle) joined_[v] = 1;
  }

  bool may_join(Index v) const { return region_[v] != 0 && joined_[v] == 0; }

  // Adds `v` if its triangles with corners in the disk form one fan over an arc of the disk's
  // boundary, because two disks that share an arc form a disk. Returns whether it was added.
  bool join(Index v) {
    std::vector<std::array<Index, 2>> arc;
    for (const Index t : topology_.vertex_triangles[v]) {
      const auto [p, q] = opposite_side(topology_.triangles[t], v);
      if (joined_[p] != 0 && joined_[q] != 0) arc.push_back({p, q});
    }
    if (!is_arc(arc)) return false;
    for (const auto& [p, q] : arc) {
      if (!is_boundary(p, q)) return false;
    }
    joined_[v] = 1;
    return true;
  }

  VertexSet vertices() const {
    VertexSet list;
    for (Index v = 0; v < joined_.size(); ++v) {
      if (joined_[v] != 0) list.push_back(v);
    }
    return list;
  }

 private:
  static std::array<Index, 2> opposite_side(const Triangle& t, Index v) {
    const std::size_t at = t[0] == v ? 0 : t[1] == v ? 1 : 2;
    return {t[(at + 1) % 3], t[(at + 2) % 3]};
  }

  // Returns whether the directed edges form one open path.
  static bool is_arc(std::vector<std::array<Index, 2>>& edges) {
    if (edges.empty()) return false;
    std::sort(edges.begin(), edges.end());
    const auto leaving = [&](Index v) {
      return std::lower_bound(edges.begin(), edges.end(), std::array<Index, 2>{v, 0});
    };
    std::vector<Index> ends;
    for (std::size_t k = 0; k < edges.size(); ++k) {
      if (k > 0 && edges[k][0] == edges[k - 1][0]) return false;
      ends.push_back(edges[k][1]);
    }
    std::sort(ends.begin(), ends.end());
    if (std::adjacent_find(ends.begin(), ends.end()) != ends.end()) return false;
    const auto first = std::find_if(edges.begin(), edges.end(), [&](const auto& edge) {
      return !std::binary_search(ends.begin(), ends.end(), edge[0]);
    });
    if (first == edges.end()) return false;
    std::size_t passed = 0;
    for (auto at = first; at != edges.end() && passed < edges.size(); ++passed) {
      const Index end = (*at)[1];
      at = leaving(end);
      if (at != edges.end() && (*at)[0] != end) at = edges.end();
    }
    return passed == edges.size();
  }

  // Returns whether exactly one triangle of the disk has the edge pq, and traverses it from q to p.
  bool is_boundary(Index p, Index q) const {
    int backward = 0;
    int other = 0;
    for (const Index t : topology_.vertex_triangles[p]) {
      const auto [from, to] = opposite_side(topology_.triangles[t], p);
      if ((from != q && to != q) || joined_[from] == 0 || joined_[to] == 0) continue;
      // The triangle p, from, to traverses q -> p if q is its last corner.
      ++(to == q ? backward : other);
    }
    return backward == 1 && other == 0;
  }

  const Topology& topology_;
  const std::vector<char>& region_;
  std::vector<char> joined_;
};

// Returns the triangles of the first component with the largest number of triangles.
std::vector<Index> largest_piece(const RegionTriangles& part, const Adjacency& sides) {
  UnionFind pieces(part.triangles.size());
  for (std::size_t e = 0; e < sides.row_count(); ++e) {
    for (const Index side : sides[e]) pieces.unite(sides[e][0] / 3, side / 3);
  }
  std::vector<std::size_t> sizes(part.triangles.size(), 0);
  for (Index t = 0; t < sizes.size(); ++t) ++sizes[pieces.find(t)];
  const auto largest = std::max_element(sizes.begin(), sizes.end()) - sizes.begin();
  std::vector<Index> members;
  CancelCheck cancel_check;
  for (Index t = 0; t < sizes.size(); ++t) {
    cancel_check();
    if (pieces.find(t) == static_cast<Index>(largest)) members.push_back(t);
  }
  return members;
}

// Returns the mesh vertices of edges that do not have exactly two triangles.
VertexSet rim(const RegionTriangles& part, const Adjacency& sides) {
  std::vector<Index> found;
  for (std::size_t e = 0; e < sides.row_count(); ++e) {
    if (sides.size(e) == 2) continue;
    found.push_back(part.vertices[side_start(part.triangles, sides[e][0])]);
    found.push_back(part.vertices[side_end(part.triangles, sides[e][0])]);
  }
  return make_vertex_set(std::move(found));
}

// Returns whether no other triangle has the same corners.
bool is_single(const Triangle& triangle, const Topology& topology) {
  const auto around = topology.vertex_triangles[triangle[0]];
  return std::count_if(around.begin(), around.end(), [&](Index t) {
           return std::is_permutation(triangle.begin(), triangle.end(),
                                      topology.triangles[t].begin());
         }) == 1;
}

// Returns the mesh triangle of the candidate for which the smallest distance of a corner from the
// rim is largest.
const Triangle* innermost(const RegionTriangles& part, const std::vector<Index>& candidates,
                          std::span<const double> rim_distances, const Topology& topology) {
  const Triangle* best = nullptr;
  double farthest = -1.0;
  CancelCheck cancel_check;
  for (const Index own : candidates) {
    cancel_check();
    const Triangle& triangle = topology.triangles[part.sources[own]];
    double distance = kNoLimit;
    for (const Index v : triangle) distance = std::min(distance, rim_distances[v]);
    if (distance <= farthest || !is_single(triangle, topology)) continue;
    farthest = distance;
    best = &triangle;
  }
  return best;
}

}  // namespace

VertexSet largest_disk(const VertexSet& region, const Topology& topology,
                       std::span<const Eigen::Vector3d> positions) {
  const RegionTriangles part = region_triangles(region, topology);
  if (part.triangles.empty()) return {};
  const Adjacency sides = sides_by_edge(part.triangles, part.vertices.size());
  if (report_disk(part, sides).is_disk()) return part.vertices;
  const std::vector<char> allowed = vertex_mask(topology.vertex_count(), part.vertices);
  const VertexSet rim_vertices = rim(part, sides);
  const std::vector<double> rim_distances =
      geodesic_distances(topology, positions, rim_vertices, kNoLimit, allowed);
  const Triangle* seed = innermost(part, largest_piece(part, sides), rim_distances, topology);
  if (seed == nullptr) return {};
  const std::vector<double> distances =
      geodesic_distances(topology, positions, *seed, kNoLimit, allowed);
  Disk disk(topology, allowed);
  disk.start_with(*seed);
  // A vertex that could not be added is tried again after a neighbour was added.
  using Candidate = std::pair<double, Index>;
  std::priority_queue<Candidate, std::vector<Candidate>, std::greater<>> front;
  const auto offer_ring = [&](Index v) {
    for (const Index w : topology.rings[v]) {
      if (disk.may_join(w)) front.emplace(distances[w], w);
    }
  };
  for (const Index v : *seed) offer_ring(v);
  CancelCheck cancel_check;
  while (!front.empty()) {
    cancel_check();
    const Index v = front.top().second;
    front.pop();
    if (disk.may_join(v) && disk.join(v)) offer_ring(v);
  }
  return disk.vertices();
}

}  // namespace lapwing
