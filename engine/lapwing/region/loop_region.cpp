#include "lapwing/region/loop_region.h"

#include <algorithm>
#include <unordered_set>

#include "lapwing/base/cancellation.h"
#include "lapwing/base/errors.h"
#include "lapwing/mesh/edges.h"
#include "lapwing/region/edge_path.h"

namespace lapwing {
namespace {

// Undirected edges, each packed into one number.
class EdgeSet {
 public:
  void toggle(Index a, Index b) {
    if (!edges_.erase(key(a, b))) edges_.insert(key(a, b));
  }
  bool contains(Index a, Index b) const { return edges_.contains(key(a, b)); }
  bool empty() const { return edges_.empty(); }

 private:
  static std::uint64_t key(Index a, Index b) {
    return (std::uint64_t{std::min(a, b)} << 32) | std::max(a, b);
  }
  std::unordered_set<std::uint64_t> edges_;
};

struct ClosedLoop {
  std::vector<Index> vertices;  // in order, without the repeated first
  EdgeSet cut;
};

ClosedLoop join(const std::vector<Index>& corners, const std::string& where, const Mesh& mesh) {
  ClosedLoop loop;
  for (std::size_t k = 0; k < corners.size(); ++k) {
    const Index from = corners[k];
    const Index to = corners[(k + 1) % corners.size()];
    const std::vector<Index> path = shortest_edge_path(mesh.topology(), mesh.positions, from, to);
    if (path.empty()) {
      throw InputError(where + "/loop/" + std::to_string(k) +
                           ": no path of edges leads from vertex " + std::to_string(from) +
                           " to vertex " + std::to_string(to) +
                           ", which lies on another component; draw the loop on one component",
                       {from, to});
    }
    for (std::size_t p = 0; p + 1 < path.size(); ++p) {
      loop.vertices.push_back(path[p]);
      loop.cut.toggle(path[p], path[p + 1]);
    }
  }
  return loop;
}

class Flood {
 public:
  Flood(const Topology& topology, const EdgeSet& cut)
      : topology_(topology), cut_(cut), reached_(topology.triangles.size(), 0) {}

  void run_from(Index vertex) {
    for (const Index t : topology_.vertex_triangles[vertex]) reach(t);
    CancelCheck cancel_check;
    while (!stack_.empty()) {
      cancel_check();
      const Triangle& triangle = topology_.triangles[stack_.back()];
      stack_.pop_back();
      for (std::size_t e = 0; e < 3; ++e) cross(triangle[e], triangle[(e + 1) % 3]);
    }
  }

  // Returns how many of the triangles on edge ab were reached.
  int sides_reached(Index a, Index b) const {
    int sides = 0;
    for (const Index t : topology_.vertex_triangles[a]) {
      if (reached_[t] && contains(topology_.triangles[t], b)) ++sides;
    }
    return sides;
  }

  std::vector<Index> vertices() const {
    std::vector<Index> found;
    for (std::size_t t = 0; t < reached_.size(); ++t) {
      if (!reached_[t]) continue;
      found.insert(found.end(), topology_.triangles[t].begin(), topology_.triangles[t].end());
    }
    return found;
  }

 private:
  static bool contains(const Triangle& t, Index v) { return t[0] == v || t[1] == v || t[2] == v; }

  void reach(Index t) {
    if (reached_[t]) return;
    reached_[t] = 1;
    stack_.push_back(t);
  }

  void cross(Index a, Index b) {
    if (cut_.contains(a, b)) return;
    for (const Index t : topology_.vertex_triangles[a]) {
      if (contains(topology_.triangles[t], b)) reach(t);
    }
  }

  const Topology& topology_;
  const EdgeSet& cut_;
  std::vector<char> reached_;
  std::vector<Index> stack_;
};

}  // namespace

VertexSet resolve_loop(const LoopRegion& region, const std::string& where, const Mesh& mesh) {
  const ClosedLoop loop = join(region.loop, where, mesh);
  const std::string inside = std::to_string(region.inside);
  if (loop.cut.empty()) {
    throw InputError(where +
                     "/loop: the loop runs back over its own edges and encloses nothing; "
                     "add vertices so that it goes around the region");
  }
  if (std::find(loop.vertices.begin(), loop.vertices.end(), region.inside) != loop.vertices.end()) {
    throw InputError(
        where + "/inside: vertex " + inside + " lies on the loop; choose one on the side to keep",
        {region.inside});
  }
  Flood flood(mesh.topology(), loop.cut);
  flood.run_from(region.inside);
  bool touches = false;
  for (std::size_t k = 0; k < loop.vertices.size(); ++k) {
    const Index a = loop.vertices[k];
    const Index b = loop.vertices[(k + 1) % loop.vertices.size()];
    if (!loop.cut.contains(a, b)) continue;
    const int sides = flood.sides_reached(a, b);
    touches = touches || sides > 0;
    if (sides > 1) {
      throw InputError(where + "/loop: the loop does not separate the mesh: vertex " + inside +
                           " reaches both sides of its edge " + name_edge(a, b) +
                           "; close the loop around one part, or cut it off with another region",
                       {region.inside, a, b});
    }
  }
  if (!touches) {
    throw InputError(where + "/inside: no path over triangles leads from vertex " + inside +
                         " to the loop; name a vertex on the loop's own component",
                     {region.inside});
  }
  std::vector<Index> vertices = flood.vertices();
  vertices.insert(vertices.end(), loop.vertices.begin(), loop.vertices.end());
  return make_vertex_set(std::move(vertices));
}

}  // namespace lapwing
