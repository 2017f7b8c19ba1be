#include "lapwing/region/region_spec.h"

#include <algorithm>
#include <limits>
#include <numeric>
#include <sstream>
#include <unordered_set>

#include "lapwing/base/cancellation.h"
#include "lapwing/base/errors.h"
#include "lapwing/mesh/edges.h"
#include "lapwing/region/geodesic.h"
#include "lapwing/region/largest_disk.h"

namespace lapwing {
namespace {

using Eigen::Vector3d;

// A set of undirected edges, each stored as one integer.
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
  std::vector<Index> vertices;  // in order; the first is not repeated
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

  // Returns the number of reached triangles at edge ab.
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

// Resolves a loop. All vertices of the loop must exist. The loop cuts the surface along each edge
// that it traverses an odd number of times. The region consists of the triangles that can be
// reached from `inside` across uncut edges. If both sides of a cut edge are in the region, the loop
// does not separate the mesh. Throws InputError as `resolve` does.
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

std::string in_words(const Vector3d& p) {
  std::ostringstream text;
  text << "(" << p.x() << ", " << p.y() << ", " << p.z() << ")";
  return text.str();
}

void require_vertex(Index v, const Mesh& mesh, const std::string& where) {
  if (v < mesh.vertex_count()) return;
  throw InputError(where + ": vertex " + std::to_string(v) + " is not in the mesh, which has " +
                       std::to_string(mesh.vertex_count()) + " vertices (numbered from 0)",
                   {v});
}

void require_vertices(const std::vector<Index>& vertices, const Mesh& mesh,
                      const std::string& where) {
  for (std::size_t k = 0; k < vertices.size(); ++k) {
    require_vertex(vertices[k], mesh, where + "/" + std::to_string(k));
  }
}

Index nearest_vertex_with_ring(const Vector3d& point, const Mesh& mesh, const std::string& where) {
  const Adjacency& rings = mesh.topology().rings;
  Index nearest = kNoIndex;
  double least = std::numeric_limits<double>::infinity();
  CancelCheck cancel_check;
  for (Index v = 0; v < mesh.vertex_count(); ++v) {
    cancel_check();
    if (rings.size(v) == 0) continue;
    const double squared = (mesh.positions[v] - point).squaredNorm();
    if (squared < least) {
      least = squared;
      nearest = v;
    }
  }
  if (nearest == kNoIndex) {
    throw InputError(where + ": the point is not finite; give three finite numbers");
  }
  return nearest;
}

// Resolves a region form; one overload per form.
struct Resolver {
  const Mesh& mesh;
  const std::string& where;

  VertexSet operator()(const AllVertices&) const {
    VertexSet all(mesh.vertex_count());
    std::iota(all.begin(), all.end(), Index{0});
    return all;
  }

  VertexSet operator()(const ListedVertices& list) const {
    require_vertices(list.vertices, mesh, where + "/vertices");
    return make_vertex_set(list.vertices);
  }

  VertexSet operator()(const GeodesicDisk& disk) const {
    Index center = kNoIndex;
    if (const auto* number = std::get_if<Index>(&disk.center)) {
      require_vertex(*number, mesh, where + "/disk/center");
      center = *number;
    } else {
      center =
          nearest_vertex_with_ring(std::get<Vector3d>(disk.center), mesh, where + "/disk/near");
    }
    const std::vector<double> distances =
        geodesic_distances(mesh.topology(), mesh.positions, std::span(&center, 1), disk.radius);
    VertexSet vertices;
    for (Index v = 0; v < distances.size(); ++v) {
      if (distances[v] < kNoLimit) vertices.push_back(v);
    }
    return vertices;
  }

  VertexSet operator()(const Box& box) const {
    VertexSet vertices;
    CancelCheck cancel_check;
    for (Index v = 0; v < mesh.vertex_count(); ++v) {
      cancel_check();
      const Vector3d& p = mesh.positions[v];
      if ((p.array() >= box.min.array()).all() && (p.array() <= box.max.array()).all()) {
        vertices.push_back(v);
      }
    }
    if (vertices.empty()) {
      const Bounds bounds = bounds_of(mesh.positions);
      throw InputError(where + "/box: no vertex lies in the box; the mesh spans " +
                       in_words(bounds.min) + " to " + in_words(bounds.max) +
                       ". Move or enlarge the box");
    }
    return vertices;
  }

  VertexSet operator()(const LoopRegion& region) const {
    if (region.loop.size() < 3) {
      throw InputError(where + "/loop: a loop needs at least 3 vertices, got " +
                       std::to_string(region.loop.size()));
    }
    require_vertices(region.loop, mesh, where + "/loop");
    require_vertex(region.inside, mesh, where + "/inside");
    return resolve_loop(region, where, mesh);
  }

  VertexSet operator()(const UnionRegion& region) const {
    VertexSet vertices;
    for (const RegionSpec& part : region.parts) {
      vertices = unite(vertices, resolve(part, mesh));
    }
    return vertices;
  }

  VertexSet operator()(const DifferenceRegion& region) const {
    if (region.parts.empty()) return {};
    VertexSet vertices = resolve(region.parts.front(), mesh);
    for (std::size_t k = 1; k < region.parts.size(); ++k) {
      vertices = subtract(vertices, resolve(region.parts[k], mesh));
    }
    if (vertices.empty()) {
      throw InputError(where + "/minus: no vertices of the first region remain; subtract less");
    }
    return vertices;
  }

  VertexSet operator()(const DiskInRegion& region) const {
    if (region.parts.empty()) return {};
    VertexSet vertices =
        largest_disk(resolve(region.parts.front(), mesh), mesh.topology(), mesh.positions);
    if (vertices.empty()) {
      throw InputError(where +
                       "/disk_in: no triangle has its three corners in the region; choose a larger "
                       "one");
    }
    return vertices;
  }
};

}  // namespace

bool operator==(const UnionRegion& a, const UnionRegion& b) {
  return a.parts == b.parts;
}
bool operator==(const DifferenceRegion& a, const DifferenceRegion& b) {
  return a.parts == b.parts;
}
bool operator==(const DiskInRegion& a, const DiskInRegion& b) {
  return a.parts == b.parts;
}

VertexSet resolve(const RegionSpec& spec, const Mesh& mesh) {
  require_surface(mesh, spec.where);
  return std::visit(Resolver{mesh, spec.where}, spec.form);
}

}  // namespace lapwing
