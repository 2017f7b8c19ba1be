#include "lapwing/region/boundary_loops.h"

#include <algorithm>

#include "lapwing/base/errors.h"
#include "lapwing/mesh/edges.h"
#include "lapwing/region/vertex_set.h"

namespace lapwing {
namespace {

// The boundary, as the next vertex of each boundary vertex.
struct Boundary {
  std::vector<Index> next;      // per vertex: next vertex on the boundary, or kNoIndex
  std::vector<Index> arrivals;  // per vertex: number of boundary edges that end there
  std::vector<Index> touched;   // vertices from which two boundary edges start
  VertexSet odd_ends;           // ends of non-manifold or inconsistently oriented edges
};

// Returns 1 + the largest vertex index of the triangles.
std::size_t vertex_count_of(std::span<const Triangle> triangles) {
  std::size_t count = 0;
  for (const Triangle& triangle : triangles) {
    count = std::max<std::size_t>(count, std::ranges::max(triangle) + std::size_t{1});
  }
  return count;
}

Boundary collect(std::span<const Triangle> triangles, const Adjacency& sides) {
  const std::size_t vertex_count = vertex_count_of(triangles);
  Boundary boundary;
  boundary.next.assign(vertex_count, kNoIndex);
  boundary.arrivals.assign(vertex_count, 0);
  for (std::size_t e = 0; e < sides.row_count(); ++e) {
    const auto on_edge = sides[e];
    const Index from = side_start(triangles, on_edge[0]);
    const Index to = side_end(triangles, on_edge[0]);
    if (on_edge.size() == 1) {
      if (boundary.next[from] != kNoIndex) boundary.touched.push_back(from);
      boundary.next[from] = to;
      ++boundary.arrivals[to];
    } else if (on_edge.size() > 2 || side_start(triangles, on_edge[1]) == from) {
      boundary.odd_ends.push_back(from);
      boundary.odd_ends.push_back(to);
    }
  }
  boundary.odd_ends = make_vertex_set(std::move(boundary.odd_ends));
  return boundary;
}

void require_loops(const Boundary& boundary, const std::string& where) {
  VertexSet wrong = boundary.touched;
  for (Index v = 0; v < boundary.next.size(); ++v) {
    const bool leads_on = boundary.next[v] != kNoIndex;
    if (boundary.arrivals[v] != (leads_on ? 1U : 0U)) wrong.push_back(v);
  }
  wrong = make_vertex_set(std::move(wrong));
  if (wrong.empty()) return;
  const VertexSet at_odd_edges = intersect(wrong, boundary.odd_ends);
  if (!at_odd_edges.empty()) {
    throw InputError(where + ": the boundary is not a closed loop: it ends at " +
                         name_vertices(at_odd_edges) +
                         ", at edges with more than two triangles, or with two triangles of "
                         "opposite orientation. Run `lapwing check MESH`, repair the mesh with "
                         "--fix, or remove these vertices from the region",
                     at_odd_edges);
  }
  throw InputError(
      where + ": the boundary touches itself at " + name_vertices(wrong) +
          ". Give each surface there its own vertex with `lapwing check MESH --fix OUT`, "
          "or add or remove the triangles around it",
      wrong);
}

}  // namespace

std::vector<BoundaryLoop> boundary_loops(std::span<const Triangle> triangles,
                                         const std::string& where) {
  return boundary_loops(triangles, sides_by_edge(triangles, vertex_count_of(triangles)), where);
}

std::vector<BoundaryLoop> boundary_loops(std::span<const Triangle> triangles,
                                         const Adjacency& sides, const std::string& where) {
  const Boundary boundary = collect(triangles, sides);
  require_loops(boundary, where);
  std::vector<BoundaryLoop> loops;
  std::vector<char> seen(boundary.next.size(), 0);
  for (Index first = 0; first < boundary.next.size(); ++first) {
    if (boundary.next[first] == kNoIndex || seen[first]) continue;
    BoundaryLoop& loop = loops.emplace_back();
    for (Index v = first; !seen[v]; v = boundary.next[v]) {
      seen[v] = 1;
      loop.push_back(v);
    }
  }
  return loops;
}

long euler_characteristic(std::span<const Triangle> triangles, const Adjacency& sides) {
  std::vector<char> used(vertex_count_of(triangles), 0);
  for (const Triangle& corners : triangles) {
    for (const Index v : corners) used[v] = 1;
  }
  return static_cast<long>(std::count(used.begin(), used.end(), 1)) -
         static_cast<long>(sides.row_count()) + static_cast<long>(triangles.size());
}

}  // namespace lapwing
