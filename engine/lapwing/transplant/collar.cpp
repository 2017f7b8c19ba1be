#include "lapwing/transplant/collar.h"

#include <algorithm>
#include <iterator>
#include <numeric>
#include <utility>

#include "lapwing/base/cancellation.h"
#include "lapwing/base/errors.h"
#include "lapwing/base/union_find.h"
#include "lapwing/mesh/edges.h"
#include "lapwing/parameterize/domain_locator.h"
#include "lapwing/region/geodesic.h"
#include "lapwing/region/vertex_set.h"

namespace lapwing {
namespace {

using Eigen::Vector3d;

// Splits a piece into the collar and the core, the rest of the piece.
class CoreSplitter {
 public:
  CoreSplitter(std::span<const Triangle> piece, std::span<const double> distances, double width)
      : piece_(piece), sides_(sides_by_edge(piece, distances.size())), is_core_(piece.size()) {
    for (std::size_t t = 0; t < piece.size(); ++t) {
      is_core_[t] = std::none_of(piece[t].begin(), piece[t].end(),
                                 [&](Index v) { return distances[v] < width; });
    }
    around_ = triangles_around_vertices(distances.size(), piece);
  }

  // Repeats until the core is one component in which every vertex has one fan. Every iteration but
  // the last removes triangles.
  void clean() {
    do {
      check_cancelled();
      keep_largest_core();
    } while (release_pinched());
  }

  std::vector<Triangle> collar() const {
    std::vector<Triangle> triangles;
    for (std::size_t t = 0; t < piece_.size(); ++t) {
      if (is_core_[t] == 0) triangles.push_back(piece_[t]);
    }
    return triangles;
  }
  bool has_core() const { return std::find(is_core_.begin(), is_core_.end(), 1) != is_core_.end(); }

 private:
  void keep_largest_core() {
    UnionFind pieces(piece_.size());
    for (std::size_t e = 0; e < sides_.row_count(); ++e) {
      const auto sides = sides_[e];
      for (std::size_t k = 1; k < sides.size(); ++k) {
        const Index a = sides[0] / 3;
        const Index b = sides[k] / 3;
        if (is_core_[a] != 0 && is_core_[b] != 0) pieces.unite(a, b);
      }
    }
    std::vector<std::size_t> counts(piece_.size(), 0);
    for (Index t = 0; t < piece_.size(); ++t) {
      if (is_core_[t] != 0) ++counts[pieces.find(t)];
    }
    const auto largest =
        static_cast<Index>(std::max_element(counts.begin(), counts.end()) - counts.begin());
    for (Index t = 0; t < piece_.size(); ++t) {
      if (is_core_[t] != 0 && pieces.find(t) != largest) is_core_[t] = 0;
    }
  }

  // Removes the triangles around each vertex with several fans from the core. Returns whether there
  // was such a vertex.
  bool release_pinched() {
    bool any = false;
    for (Index v = 0; v < around_.row_count(); ++v) {
      if (fans_at(v) < 2) continue;
      for (const Index t : around_[v]) is_core_[t] = 0;
      any = true;
    }
    return any;
  }

  std::size_t fans_at(Index v) const {
    std::vector<std::array<Index, 2>> ends;  // per core triangle: its two corners other than v
    for (const Index t : around_[v]) {
      if (is_core_[t] == 0) continue;
      const Triangle& corners = piece_[t];
      const auto k =
          static_cast<std::size_t>(std::find(corners.begin(), corners.end(), v) - corners.begin());
      ends.push_back({corners[(k + 1) % 3], corners[(k + 2) % 3]});
    }
    std::size_t fans = ends.size();
    for (const auto& [first, second] : ends) {
      fans -= static_cast<std::size_t>(
          std::any_of(ends.begin(), ends.end(),
                      [&, end = second](const auto& other) { return other[0] == end; }));
    }
    // A closed fan has as many shared edges as triangles, but counts as one fan.
    return ends.empty() ? 0 : std::max<std::size_t>(fans, 1);
  }

  std::span<const Triangle> piece_;
  Adjacency sides_;
  Adjacency around_;
  std::vector<char> is_core_;
};

BoundaryLoop from_smallest(BoundaryLoop loop) {
  std::rotate(loop.begin(), std::min_element(loop.begin(), loop.end()), loop.end());
  return loop;
}

// A collar with its vertices renumbered.
struct OwnCollar : NumberedTriangles {
  BoundaryLoop seam;
  BoundaryLoop inner;
  std::vector<Vector3d> positions;
};

OwnCollar own_collar(const Collar& collar, std::span<const Vector3d> positions) {
  OwnCollar own{numbered(collar.triangles), {}, {}, {}};
  const std::vector<Index> numbers = inverse_index(own.vertices, positions.size());
  for (const Index v : collar.seam) own.seam.push_back(numbers[v]);
  for (const Index v : collar.inner) own.inner.push_back(numbers[v]);
  for (const Index v : own.vertices) own.positions.push_back(positions[v]);
  return own;
}

// Returns the shortest path along edges from one of `starts` to the inner loop, or nothing if there
// is none. Only its ends are on the seam and on the inner loop.
std::vector<Index> path_across(const OwnCollar& collar, std::span<const Index> starts) {
  enum Place : char { between, on_seam, on_inner };
  const std::size_t n = collar.vertices.size();
  std::vector<char> place(n, between);
  for (const Index v : collar.seam) place[v] = on_seam;
  for (const Index v : collar.inner) place[v] = on_inner;
  const Adjacency around = triangles_around_vertices(n, collar.triangles);
  const Adjacency rings = rings_by_triangles(around, collar.triangles);
  return shortest_edge_path(rings, collar.positions, starts,
                            {[&](Index v) { return place[v] == on_inner; },
                             [&](Index v) { return place[v] != on_seam; }});
}

// Returns the triangles around `v` that are reachable from triangle `first` without crossing the
// path.
std::vector<Index> star_from(Index v, Index first, const OwnCollar& collar, const Adjacency& around,
                             std::span<const Index> path_neighbours) {
  const auto shared_edge_is_open = [&](Index a, Index b) {
    for (const Index w : collar.triangles[a]) {
      if (w == v) continue;
      const auto& other = collar.triangles[b];
      if (std::find(other.begin(), other.end(), w) == other.end()) continue;
      return std::find(path_neighbours.begin(), path_neighbours.end(), w) == path_neighbours.end();
    }
    return false;
  };
  std::vector<Index> star{first};
  for (std::size_t done = 0; done < star.size(); ++done) {
    for (const Index t : around[v]) {
      if (std::find(star.begin(), star.end(), t) == star.end() &&
          shared_edge_is_open(star[done], t)) {
        star.push_back(t);
      }
    }
  }
  return star;
}

// Returns the triangle that contains the directed edge from `a` to `b`, or kNoIndex.
Index triangle_on(Index a, Index b, const OwnCollar& collar, const Adjacency& around) {
  for (const Index t : around[a]) {
    const Triangle& corners = collar.triangles[t];
    for (std::size_t k = 0; k < 3; ++k) {
      if (corners[k] == a && corners[(k + 1) % 3] == b) return t;
    }
  }
  return kNoIndex;
}

// Cuts the collar open: in triangles on the left of the path, path[i] is replaced by the new vertex
// first + i.
std::vector<Triangle> cut_open(const OwnCollar& collar, std::span<const Index> path, Index first) {
  const Adjacency around = triangles_around_vertices(collar.vertices.size(), collar.triangles);
  std::vector<Triangle> triangles = collar.triangles;
  for (std::size_t i = 0; i < path.size(); ++i) {
    std::vector<Index> neighbours;
    if (i > 0) neighbours.push_back(path[i - 1]);
    if (i + 1 < path.size()) neighbours.push_back(path[i + 1]);
    const Index left = i + 1 < path.size() ? triangle_on(path[i], path[i + 1], collar, around)
                                           : triangle_on(path[i - 1], path[i], collar, around);
    for (const Index t : star_from(path[i], left, collar, around, neighbours)) {
      for (Index& v : triangles[t]) {
        if (v == path[i]) v = first + static_cast<Index>(i);
      }
    }
  }
  return triangles;
}

}  // namespace

Collar make_collar(std::span<const Triangle> piece, const BoundaryLoop& seam,
                   std::span<const double> distances, double width, const std::string& where) {
  CoreSplitter parting(piece, distances, width);
  parting.clean();
  Collar collar;
  if (!parting.has_core()) return collar;
  collar.triangles = parting.collar();
  if (collar.triangles.empty()) return collar;
  const Adjacency sides = sides_by_edge(collar.triangles, distances.size());
  const auto loops = boundary_loops(collar.triangles, sides, where);
  const BoundaryLoop wanted = from_smallest(seam);
  VertexSet others;
  for (const BoundaryLoop& loop : loops) {
    if (loop == wanted) continue;
    collar.inner = loop;
    others.push_back(loop.front());
  }
  if (loops.size() != 2 || others.size() != 1) {
    throw InputError(where + ": the transition reaches another boundary of the mesh, at " +
                         name_vertices(others) + "; set its \"width\" below " +
                         std::to_string(width) + ", or close that hole first",
                     others);
  }
  if (euler_characteristic(collar.triangles, sides) != 0) {
    throw InputError(where + ": the transition contains a topological handle, around " +
                         name_vertices(collar.inner) + "; set its \"width\" below " +
                         std::to_string(width),
                     collar.inner);
  }
  collar.seam = seam;
  return collar;
}

Index best_cut(const Collar& collar, std::span<const Vector3d> positions,
               std::span<const char> allowed) {
  const OwnCollar own = own_collar(collar, positions);
  std::vector<Index> starts = own.seam;
  if (!allowed.empty()) {
    std::erase_if(starts, [&](Index v) { return allowed[own.vertices[v]] == 0; });
  }
  const std::vector<Index> path = path_across(own, starts);
  return path.empty() ? kNoIndex : own.vertices[path.front()];
}

std::vector<Index> cut_starts(const Collar& collar) {
  const VertexSet seam = make_vertex_set(collar.seam);
  const auto on_seam = [&](Index v) { return std::binary_search(seam.begin(), seam.end(), v); };
  std::vector<Index> starts;
  for (const Triangle& t : collar.triangles) {
    if (std::all_of(t.begin(), t.end(), on_seam)) continue;
    std::copy_if(t.begin(), t.end(), std::back_inserter(starts), on_seam);
  }
  return make_vertex_set(std::move(starts));
}

MappedCollar map_collar(const Collar& collar, std::span<const Vector3d> positions, Index start,
                        const std::string& where) {
  OwnCollar own = own_collar(collar, positions);
  const auto at = std::lower_bound(own.vertices.begin(), own.vertices.end(), start);
  std::vector<Index> path;
  if (at != own.vertices.end() && *at == start) {
    const auto number = static_cast<Index>(at - own.vertices.begin());
    path = path_across(own, std::span(&number, 1));
  }
  if (path.empty()) {
    throw InputError(where + ": no path leads across the transition from vertex " +
                     std::to_string(start) + " of the seam; make its \"width\" larger");
  }
  MappedCollar laid;
  const auto first = static_cast<Index>(own.vertices.size());
  laid.vertices = own.vertices;
  for (const Index v : path) {
    laid.vertices.push_back(own.vertices[v]);
    laid.cut.push_back(own.vertices[v]);
  }
  Mesh sheet;
  for (const Index v : laid.vertices) sheet.positions.push_back(positions[v]);
  for (const Triangle& corners : cut_open(own, path, first)) sheet.add_face(corners);
  VertexSet all(sheet.vertex_count());
  std::iota(all.begin(), all.end(), Index{0});
  laid.patch = disk_patch(all, sheet.topology(), sheet.positions, where);
  const auto last = first + static_cast<Index>(path.size()) - 1;
  const BoundaryPins pins{path.front(), first, last, path.back()};
  laid.map = mean_value_map(laid.patch, on_patch<Vector3d>(laid.patch, sheet.positions),
                            Domain::square, pins);
  return laid;
}

namespace {

// Converts a point of the patch to a point of the mesh. The weight of a midpoint is divided between
// the ends of its edge.
SurfacePoint on_mesh(const SurfacePoint& point, const MappedCollar& laid) {
  SurfacePoint result;
  std::size_t count = 0;
  const auto add = [&](Index own, double weight) {
    const Index v = laid.vertices[own];
    const auto known = std::find(result.corners.begin(), result.corners.begin() + count, v);
    const auto place = static_cast<std::size_t>(known - result.corners.begin());
    if (place == count) result.corners[count++] = v;
    result.weights[place] += weight;
  };
  const std::size_t vertex_count = laid.patch.vertices.size();
  for (std::size_t c = 0; c < 3; ++c) {
    const Index own = point.corners[c];
    const double weight = point.weights[c];
    if (weight == 0.0) continue;
    if (own < vertex_count) {
      add(own, weight);
    } else {
      for (const Index end : laid.patch.midpoint_of[own - vertex_count]) add(end, 0.5 * weight);
    }
  }
  for (std::size_t c = count; c < 3; ++c) result.corners[c] = result.corners[0];
  return result;
}

}  // namespace

std::vector<SurfacePoint> lay_on(const MappedCollar& upper, const MappedCollar& lower,
                                 std::size_t vertex_count) {
  const DomainLocator locator(lower.patch.triangles, lower.map.points);
  const std::vector<SurfacePoint> found = locator.locate(upper.map.points);
  std::vector<SurfacePoint> points(vertex_count, SurfacePoint::nowhere());
  // A vertex on the cut has two copies; either may be used.
  for (std::size_t own = 0; own < upper.vertices.size(); ++own) {
    points[upper.vertices[own]] = on_mesh(found[own], lower);
  }
  return points;
}

}  // namespace lapwing
