#include "lapwing/transplant/mapped_collar.h"

#include <algorithm>
#include <iterator>
#include <numeric>
#include <utility>

#include "lapwing/base/errors.h"
#include "lapwing/parameterize/domain_locator.h"
#include "lapwing/region/edge_path.h"

namespace lapwing {
namespace {

using Eigen::Vector3d;

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
// is none. Only its ends lie on the seam and on the inner loop.
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

// Returns the triangles around `v` reachable from triangle `first` without crossing the path.
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

// Returns the triangle with the side from `a` to `b`, or kNoIndex.
Index triangle_on(Index a, Index b, const OwnCollar& collar, const Adjacency& around) {
  for (const Index t : around[a]) {
    const Triangle& corners = collar.triangles[t];
    for (std::size_t k = 0; k < 3; ++k) {
      if (corners[k] == a && corners[(k + 1) % 3] == b) return t;
    }
  }
  return kNoIndex;
}

// Cuts the triangles open: those on the left of the path get new vertices, first + i for path[i].
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

// Converts a point of the patch to one of the mesh. A midpoint is half of each end of its edge.
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
  // A vertex on the cut has two copies, and either will do.
  for (std::size_t own = 0; own < upper.vertices.size(); ++own) {
    points[upper.vertices[own]] = on_mesh(found[own], lower);
  }
  return points;
}

}  // namespace lapwing
