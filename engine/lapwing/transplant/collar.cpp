#include "lapwing/transplant/collar.h"

#include <algorithm>

#include "lapwing/base/cancellation.h"
#include "lapwing/base/errors.h"
#include "lapwing/base/union_find.h"
#include "lapwing/mesh/triangle_sides.h"
#include "lapwing/region/vertex_set.h"

namespace lapwing {
namespace {

// Splits a piece into the collar and the core beyond it.
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

  // Repeats until the core is one piece that no vertex touches twice. Every round but the last
  // removes triangles from it.
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

  // Releases the core's triangles around each vertex at which they are not connected over edges.
  // Returns whether there were any.
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
    std::vector<std::array<Index, 2>> ends;  // per core triangle: the corners beside v
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
    // A closed fan has as many shared edges as triangles, and counts as one.
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

}  // namespace lapwing
