#include "lapwing/mesh/decimate.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>

#include <Eigen/Geometry>

#include "lapwing/base/cancellation.h"
#include "lapwing/base/parallel.h"
#include "lapwing/mesh/error_quadric.h"
#include "lapwing/mesh/incident_edges.h"
#include "lapwing/mesh/morton_order.h"

namespace lapwing {
namespace {

using Eigen::Vector3d;

// Weight of the fourth power of the edge length beside the quadric error, which is an area times a
// squared distance. Chosen on rendered images: smaller values leave needles in flat areas.
constexpr double kEdgeShare = 1e-3;
// Lower limits after a merge: height of a triangle over its longest edge, and cosine between its
// old and new normals.
constexpr double kLeastHeight = 0.15;
constexpr double kLeastCosine = 0.7;
// Limit on the neighbours of a merged vertex. More lead to needles later.
constexpr std::size_t kMostNeighbours = 14;
// Limit on the triangles at each of the two vertices. In the interior, more would always exceed
// kMostNeighbours.
constexpr std::size_t kMostAroundOne = kMostNeighbours + 2;
// A pass tries the cheapest third of the candidates. Its merges make the others more expensive.
constexpr std::size_t kCandidatesPerPass = 3;  // tries 1 in this many
constexpr std::size_t kSmallPass = 100;        // a small pass merges fewer than 1 in this many
constexpr std::size_t kVerticesPerTask = 256;

bool has(const Triangle& triangle, Index v) {
  return triangle[0] == v || triangle[1] == v || triangle[2] == v;
}

struct Merge {
  double cost = std::numeric_limits<double>::max();
  Index from = kNoIndex;
  Index into = kNoIndex;

  bool operator<(const Merge& other) const {
    return cost < other.cost || (cost == other.cost && from < other.from);
  }
};

class Decimation {
 public:
  Decimation(std::span<const Vector3d> positions, std::vector<Triangle> triangles,
             std::span<const Index> groups)
      : positions_(positions),
        groups_(groups),
        triangles_(std::move(triangles)),
        owners_(positions.size()),
        has_changed_(positions.size(), 1),
        cheapest_(positions.size()),
        is_plain_(positions.size()),
        quadrics_(positions.size()) {
    std::iota(owners_.begin(), owners_.end(), 0U);
    left_ = owners_;
    find_around();
    for_each(left_, [&](std::size_t, Index v) {
      is_plain_[v] = has_plain_spokes(v, around_[v], triangles_);
      find_quadric(v);
    });
  }

  Decimated run(std::size_t count) {
    while (left_.size() > count) {
      const std::size_t merged = pass(left_.size() - count);
      // Few of the remaining vertices can be merged, and a small pass costs as much as a large one.
      if (kSmallPass * merged < left_.size()) break;
    }
    return result();
  }

 private:
  // Calls act(index in list, entry) on several threads.
  template <typename T, typename Act>
  static void for_each(std::span<const T> list, const Act& act) {
    parallel_for(list.size(), kVerticesPerTask, [&](std::size_t begin, std::size_t end) {
      for (std::size_t k = begin; k < end; ++k) act(k, list[k]);
    });
  }
  template <typename T, typename Act>
  static void for_each(const std::vector<T>& list, const Act& act) {
    for_each(std::span<const T>(list), act);
  }

  // Updates `around_` and drops vertices without triangles from `left_`.
  void find_around() {
    around_ = triangles_around_vertices(positions_.size(), triangles_);
    std::erase_if(left_, [&](Index v) { return around_.size(v) == 0; });
  }

  // Adds the planes of the triangles at v. At a boundary edge it also adds the plane through the
  // edge perpendicular to the triangle, which holds the boundary in place.
  void find_quadric(Index v) {
    std::vector<IncidentEdge> incident;
    if (is_plain_[v] == 0) incident = incident_edges(v, around_[v], triangles_);
    const auto is_on_boundary = [&](Index w) {
      const auto at = std::lower_bound(incident.begin(), incident.end(), w,
                                       [](const IncidentEdge& s, Index to) { return s.to < to; });
      return at->triangles() == 1;
    };
    for (const Index t : around_[v]) {
      const Triangle& triangle = triangles_[t];
      const Vector3d n = normal_of(triangle, kNoIndex, kNoIndex);
      const double length = n.norm();
      if (!(length > 0.0)) continue;
      quadrics_[v].add_plane(n / length, length / 6.0);
      if (is_plain_[v] != 0) continue;
      for (const Index w : {next_corner(triangle, v), last_corner(triangle, v)}) {
        if (!is_on_boundary(w)) continue;
        const Vector3d edge = positions_[w] - positions_[v];
        quadrics_[v].add_plane(edge.cross(n).normalized(), edge.squaredNorm());
      }
    }
  }

  // Returns the normal of t with its corner `from` moved to `to`. Its length is twice the area.
  Vector3d normal_of(const Triangle& t, Index from, Index to) const {
    std::array<Vector3d, 3> p;
    for (std::size_t c = 0; c < 3; ++c) p[c] = positions_[t[c] == from ? to : t[c]];
    return (p[1] - p[0]).cross(p[2] - p[0]);
  }

  // Returns the number of edges at v with one triangle, or kMany if v must be kept: on an edge of
  // more than two triangles, or where fans meet.
  std::size_t boundary_edges(Index v, std::span<const IncidentEdge> incident) const {
    constexpr std::size_t kMany = 3;
    std::size_t open = 0;
    for (const IncidentEdge& edge : incident) {
      if (edge.triangles() > 2) return kMany;
      if (edge.triangles() == 1) ++open;
    }
    // A single fan has as many edges as triangles, or one more on a boundary.
    const std::size_t of_one_fan = around_.size(v) + (open > 0 ? 1 : 0);
    return incident.size() == of_one_fan ? open : kMany;
  }

  Merge cheapest(Index v) const {
    Merge best;
    if (groups_[v] == kKeptGroup) return best;
    const auto look_at = [&](Index j) {
      if (groups_[j] != groups_[v]) return;
      const Vector3d edge = positions_[j] - positions_[v];
      const double square = edge.squaredNorm();
      const double cost = quadrics_[v].at(edge) + quadrics_[j].c + kEdgeShare * square * square;
      if (cost < best.cost || (cost == best.cost && j < best.into)) best = {cost, v, j};
    };
    if (is_plain_[v] != 0) {
      for (const Index t : around_[v]) look_at(next_corner(triangles_[t], v));
      return best;
    }
    const std::vector<IncidentEdge> incident = incident_edges(v, around_[v], triangles_);
    const std::size_t open = boundary_edges(v, incident);
    if (open > 2) return best;
    for (const IncidentEdge& edge : incident) {
      if (open == 0 || edge.triangles() == 1) look_at(edge.to);
    }
    return best;
  }

  // Neighbours of a vertex with at most kMostAroundOne triangles.
  struct Neighbours {
    std::array<Index, 2 * kMostAroundOne> list;
    std::size_t size = 0;

    auto begin() const { return list.begin(); }
    auto end() const { return list.begin() + static_cast<std::ptrdiff_t>(size); }
    bool has(Index v) const { return std::find(begin(), end(), v) != end(); }
  };
  Neighbours neighbours_of(Index v) const {
    Neighbours found;
    for (const Index t : around_[v]) {
      const Index next = next_corner(triangles_[t], v);
      const Index last = last_corner(triangles_[t], v);
      if (is_plain_[v] != 0 || !found.has(next)) found.list[found.size++] = next;
      if (is_plain_[v] == 0 && !found.has(last)) found.list[found.size++] = last;
    }
    return found;
  }

  // Returns whether the merge meets the link condition and the limits on neighbours, heights and
  // normals.
  bool can_collapse(Index from, Index into) const {
    if (std::max(around_.size(from), around_.size(into)) > kMostAroundOne) return false;
    const Neighbours a = neighbours_of(from);
    const Neighbours b = neighbours_of(into);
    const auto common = static_cast<std::size_t>(
        std::count_if(a.begin(), a.end(), [&](Index v) { return b.has(v); }));
    if (a.size + b.size - 2 - common > kMostNeighbours) return false;
    const auto around = around_[from];
    const auto on = static_cast<std::size_t>(std::count_if(
        around.begin(), around.end(), [&](Index t) { return has(triangles_[t], into); }));
    if (common != on || around.size() + around_.size(into) == 2 * on) return false;
    return std::all_of(around.begin(), around.end(), [&](Index t) {
      const Triangle& triangle = triangles_[t];
      return has(triangle, into) || keeps_shape(triangle, from, into);
    });
  }
  bool keeps_shape(const Triangle& t, Index from, Index into) const {
    const Vector3d before = normal_of(t, kNoIndex, kNoIndex);
    const Vector3d after = normal_of(t, from, into);
    double longest = 0.0;
    for (std::size_t c = 0; c < 3; ++c) {
      const Index p = t[c] == from ? into : t[c];
      const Index q = t[(c + 1) % 3] == from ? into : t[(c + 1) % 3];
      longest = std::max(longest, (positions_[p] - positions_[q]).squaredNorm());
    }
    const double length = after.norm();
    return length >= kLeastHeight * longest &&
           before.dot(after) >= kLeastCosine * before.norm() * length;
  }

  // Returns the third corners of the triangles on the edge ab, at most two.
  std::array<Index, 2> corners_beside(Index a, Index b) const {
    std::array<Index, 2> beside{kNoIndex, kNoIndex};
    std::size_t count = 0;
    for (const Index t : around_[a]) {
      if (!has(triangles_[t], b) || count == beside.size()) continue;
      for (const Index v : triangles_[t]) {
        if (v != a && v != b) beside[count] = v;
      }
      ++count;
    }
    return beside;
  }

  // Returns the merges to make in one pass, cheapest first: at most `most`, no two of them
  // adjacent.
  std::vector<Merge> compatible(std::vector<Merge> merges, std::size_t most) const {
    const std::size_t tried =
        std::min(std::max<std::size_t>(merges.size() / kCandidatesPerPass, 1), merges.size());
    const auto end_of_tried = merges.begin() + static_cast<std::ptrdiff_t>(tried);
    std::vector<char> may(merges.size(), 0);
    const auto ask = [&](std::size_t begin, std::size_t end) {
      for_each(
          std::span<const Merge>(merges).subspan(begin, end - begin),
          [&](std::size_t k, const Merge& m) { may[begin + k] = can_collapse(m.from, m.into); });
    };
    std::nth_element(merges.begin(), end_of_tried, merges.end());
    std::sort(merges.begin(), end_of_tried);
    ask(0, tried);
    std::vector<char> is_taken(positions_.size(), 0);
    std::vector<char> loses(positions_.size(), 0);  // whether the vertex loses a triangle
    std::vector<Merge> made;
    // Try the others only if few of the cheapest could be made.
    const auto goes_on = [&](std::size_t k) {
      return made.size() < most && (k < tried || kSmallPass / 2 * made.size() < merges.size());
    };
    CancelCheck check;
    for (std::size_t k = 0; k < merges.size() && goes_on(k); ++k) {
      check();
      if (k == tried) {
        std::sort(end_of_tried, merges.end());
        ask(tried, merges.size());
      }
      const auto [cost, from, into] = merges[k];
      if (is_taken[from] != 0 || may[k] == 0) continue;
      const auto beside = corners_beside(from, into);
      if (std::any_of(beside.begin(), beside.end(), [&](Index v) {
            return v != kNoIndex && (loses[v] != 0 || around_.size(v) < 2);
          })) {
        continue;
      }
      for (const Index v : beside) {
        if (v != kNoIndex) loses[v] = 1;
      }
      for (const Index t : around_[from]) {
        for (const Index v : triangles_[t]) is_taken[v] = 1;
      }
      made.push_back(merges[k]);
    }
    return made;
  }

  // Merges at most `most` vertices, no two of them adjacent. Returns how many.
  std::size_t pass(std::size_t most) {
    std::vector<Merge> merges(left_.size());
    for_each(left_, [&](std::size_t k, Index v) {
      if (has_changed_[v] != 0) cheapest_[v] = cheapest(v);
      merges[k] = cheapest_[v];
    });
    std::erase_if(merges, [](const Merge& merge) { return merge.from == kNoIndex; });
    merges = compatible(std::move(merges), most);
    for (const auto& [cost, from, into] : merges) merge(from, into);
    std::erase_if(triangles_,
                  [](const Triangle& t) { return t[0] == t[1] || t[1] == t[2] || t[2] == t[0]; });
    find_around();
    find_plain_around(merges);
    find_changed(merges);
    return merges.size();
  }

  void merge(Index from, Index into) {
    owners_[from] = into;
    quadrics_[into].add(quadrics_[from], positions_[into] - positions_[from]);
    for (const Index t : around_[from]) {
      for (Index& corner : triangles_[t]) {
        if (corner == from) corner = into;
      }
    }
  }

  // The cost of a vertex depends on its neighbours and their quadrics.
  void find_changed(std::span<const Merge> merges) {
    std::fill(has_changed_.begin(), has_changed_.end(), char{0});
    for (const Merge& merge : merges) {
      for (const Index t : around_[merge.into]) {
        for (const Index v : triangles_[t]) has_changed_[v] = 1;
      }
    }
  }

  // Two merges of one pass may have pinched the surface at an edge of a merged vertex.
  void find_plain_around(std::span<const Merge> merges) {
    std::vector<char> is_still(merges.size());
    for_each(merges, [&](std::size_t k, const Merge& merge) {
      is_still[k] = is_plain_[merge.into] != 0 &&
                    has_plain_spokes(merge.into, around_[merge.into], triangles_);
    });
    for (std::size_t k = 0; k < merges.size(); ++k) {
      if (is_still[k] != 0) continue;
      const Index into = merges[k].into;
      for (const IncidentEdge& edge : incident_edges(into, around_[into], triangles_)) {
        if (!edge.is_plain()) is_plain_[edge.to] = is_plain_[into] = 0;
      }
    }
  }

  Decimated result() {
    Decimated result;
    const std::size_t n = positions_.size();
    std::vector<Index> own(n, kNoIndex);
    for (std::size_t k = 0; k < left_.size(); ++k) own[left_[k]] = static_cast<Index>(k);
    result.owners.resize(n);
    for (Index v = 0; v < n; ++v) {
      Index last = v;
      while (owners_[last] != last) last = owners_[last];
      result.owners[v] = own[last];
    }
    result.kept = std::move(left_);
    result.triangles = std::move(triangles_);
    for (Triangle& t : result.triangles) {
      for (Index& corner : t) corner = own[corner];
    }
    return result;
  }

  std::span<const Vector3d> positions_;
  std::span<const Index> groups_;
  std::vector<Triangle> triangles_;
  std::vector<Index> left_;        ///< vertices that have triangles, ascending
  std::vector<Index> owners_;      ///< per vertex: the vertex it was merged into, or itself
  std::vector<char> has_changed_;  ///< per vertex: whether `cheapest_` must be recomputed
  std::vector<Merge> cheapest_;    ///< per vertex
  /// Per vertex: a cached result of `has_plain_spokes`. The entry may remain 0 after a merge has
  /// made all incident edges plain.
  std::vector<char> is_plain_;
  std::vector<ErrorQuadric> quadrics_;
  Adjacency around_;
};

// The surface, renumbered so that neighbours are close in memory. Memory access takes most of the
// time.
struct Renumbered {
  std::vector<Index> vertices;  // new number -> original vertex
  std::vector<Vector3d> positions;
  std::vector<Triangle> triangles;
  std::vector<Index> groups;
};

Renumbered renumbered(std::span<const Vector3d> positions, std::vector<Triangle> triangles,
                      std::span<const Index> groups) {
  std::vector<Eigen::Vector3f> points;
  points.reserve(positions.size());
  for (const Vector3d& p : positions) points.emplace_back((p - positions[0]).cast<float>());
  Renumbered result;
  result.vertices = morton_order(points);
  for (const Index v : result.vertices) {
    result.positions.push_back(positions[v]);
    result.groups.push_back(groups[v]);
  }
  const std::vector<Index> own = inverse_index(result.vertices, positions.size());
  std::vector<Index> firsts;
  for (Triangle& t : triangles) {
    for (Index& corner : t) corner = own[corner];
    firsts.push_back(*std::min_element(t.begin(), t.end()));
  }
  for (const Index t : inverse_lists(firsts, positions.size()).values) {
    result.triangles.push_back(triangles[t]);
  }
  return result;
}

// Converts the result back to the original numbers and sorts `kept`.
Decimated numbered_as_given(Decimated own, std::span<const Index> vertices) {
  Decimated result;
  for (const Index k : own.kept) result.kept.push_back(vertices[k]);
  std::sort(result.kept.begin(), result.kept.end());
  const std::vector<Index> places = inverse_index(result.kept, vertices.size());
  const auto place = [&](Index k) { return places[vertices[own.kept[k]]]; };
  for (const auto& [a, b, c] : own.triangles) {
    result.triangles.push_back({place(a), place(b), place(c)});
  }
  result.owners.resize(vertices.size(), kNoIndex);
  for (std::size_t k = 0; k < vertices.size(); ++k) {
    if (own.owners[k] != kNoIndex) result.owners[vertices[k]] = place(own.owners[k]);
  }
  return result;
}

}  // namespace

Decimated decimate(std::span<const Vector3d> positions, std::vector<Triangle> triangles,
                   std::span<const Index> groups, std::size_t count) {
  Renumbered own = renumbered(positions, std::move(triangles), groups);
  Decimation decimation(own.positions, std::move(own.triangles), own.groups);
  return numbered_as_given(decimation.run(count), own.vertices);
}

}  // namespace lapwing
