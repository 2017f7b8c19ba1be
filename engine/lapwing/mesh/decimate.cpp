#include "lapwing/mesh/decimate.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>

#include <Eigen/Geometry>

#include "lapwing/base/cancellation.h"
#include "lapwing/base/parallel.h"

namespace lapwing {
namespace {

using Eigen::Vector3d;

// Of the fourth power of an edge's length, beside the quadric error, which is an area times a
// squared distance. Chosen by pictures: less leaves needles in flat parts.
constexpr double kEdgeShare = 1e-3;
// What is left of a triangle's height over its longest edge, and of the cosine between its normals.
constexpr double kLeastHeight = 0.15;
constexpr double kLeastCosine = 0.7;
// Around what is left of two vertices: more make needles later.
constexpr std::size_t kMostNeighbours = 14;
// Of the candidates of a pass, the cheapest; the others are more expensive by then.
constexpr std::size_t kCandidatesPerPass = 3;  // one in
constexpr std::size_t kSmallPass = 100;        // merges less than one in so many
constexpr std::size_t kVerticesPerTask = 2048;

// sum_t area_t (squared distance from the plane of t), as a polynomial about a vertex of its own,
// which keeps the numbers small far from the origin.
struct Quadric {
  Eigen::Matrix3d A = Eigen::Matrix3d::Zero();
  Vector3d g = Vector3d::Zero();
  double c = 0.0;

  // A plane through the vertex.
  void add_plane(const Vector3d& normal, double area) { A += area * normal * normal.transpose(); }
  double at(const Vector3d& offset) const { return offset.dot(A * offset + 2.0 * g) + c; }
  // `other` about a vertex that lies at -offset from this one's.
  void add(const Quadric& other, const Vector3d& offset) {
    A += other.A;
    g += other.g + other.A * offset;
    c += other.at(offset);
  }
};

bool has(const Triangle& triangle, Index v) {
  return triangle[0] == v || triangle[1] == v || triangle[2] == v;
}

struct Merge {
  double cost = std::numeric_limits<double>::infinity();
  Index from = kNoIndex;
  Index into = kNoIndex;
};

class Decimation {
 public:
  Decimation(std::span<const Vector3d> positions, std::vector<Triangle> triangles,
             std::span<const Index> groups)
      : positions_(positions),
        groups_(groups),
        triangles_(std::move(triangles)),
        owners_(positions.size()),
        quadrics_(positions.size()) {
    std::iota(owners_.begin(), owners_.end(), 0U);
    find_around();
    CancelCheck check;
    for (const Triangle& t : triangles_) {
      check();
      add_planes(t);
    }
  }

  Decimated run(std::size_t count) {
    std::size_t left = used_count();
    while (left > count) {
      const std::size_t merged = pass(left - count);
      left -= merged;
      find_around();
      // What is left may hardly be merged: each pass costs as much as a large one.
      if (kSmallPass * merged < left) break;
    }
    return result();
  }

 private:
  // What changes from pass to pass.
  void find_around() {
    around_ = triangles_around_vertices(positions_.size(), triangles_);
    rings_ = rings_by_triangles(around_, triangles_);
  }
  // That of a triangle, and across its sides on a boundary, which keep that where it is.
  void add_planes(const Triangle& t) {
    const Vector3d n = normal_of(t, kNoIndex, kNoIndex);
    const double length = n.norm();
    if (!(length > 0.0)) return;
    for (const Index v : t) quadrics_[v].add_plane(n / length, length / 6.0);
    for (std::size_t c = 0; c < 3; ++c) {
      const Index a = t[c];
      const Index b = t[(c + 1) % 3];
      if (triangles_on(a, b) != 1) continue;
      const Vector3d edge = positions_[b] - positions_[a];
      const Vector3d across = edge.cross(n).normalized();
      for (const Index v : {a, b}) quadrics_[v].add_plane(across, edge.squaredNorm());
    }
  }
  std::size_t used_count() const {
    std::size_t used = 0;
    for (std::size_t v = 0; v < positions_.size(); ++v) used += around_.size(v) > 0 ? 1 : 0;
    return used;
  }

  // With `from` where `to` is; twice the area long.
  Vector3d normal_of(const Triangle& t, Index from, Index to) const {
    std::array<Vector3d, 3> p;
    for (std::size_t c = 0; c < 3; ++c) p[c] = positions_[t[c] == from ? to : t[c]];
    return (p[1] - p[0]).cross(p[2] - p[0]);
  }

  std::size_t triangles_on(Index a, Index b) const {
    const auto around = around_[a];
    return static_cast<std::size_t>(std::count_if(around.begin(), around.end(),
                                                  [&](Index t) { return has(triangles_[t], b); }));
  }

  // Edges with one triangle at v; many where v is to be kept: on an edge of more than two
  // triangles, or where fans meet.
  std::size_t boundary_edges(Index v) const {
    constexpr std::size_t kMany = 3;
    std::size_t open = 0;
    for (const Index j : rings_[v]) {
      const std::size_t on = triangles_on(v, j);
      if (on > 2) return kMany;
      if (on == 1) ++open;
    }
    // One fan has as many edges as triangles, or one more with a boundary.
    const std::size_t of_one_fan = around_.size(v) + (open > 0 ? 1 : 0);
    return rings_.size(v) == of_one_fan ? open : kMany;
  }

  Merge cheapest(Index v) const {
    Merge best;
    if (groups_[v] == kKeptGroup || around_.size(v) == 0) return best;
    const std::size_t open = boundary_edges(v);
    if (open > 2) return best;
    for (const Index j : rings_[v]) {
      if (groups_[j] != groups_[v] || (open > 0 && triangles_on(v, j) != 1)) continue;
      const Vector3d edge = positions_[j] - positions_[v];
      const double square = edge.squaredNorm();
      const double cost = quadrics_[v].at(edge) + quadrics_[j].c + kEdgeShare * square * square;
      if (cost < best.cost) best = {cost, v, j};
    }
    return best;
  }

  // Whether the surface stays one, and no triangle folds or becomes a needle.
  bool may_merge(Index from, Index into) const {
    const auto a = rings_[from];
    const auto b = rings_[into];
    std::size_t common = 0;
    for (const Index j : a) common += std::binary_search(b.begin(), b.end(), j) ? 1 : 0;
    const std::size_t on = triangles_on(from, into);
    if (common != on || around_.size(from) + around_.size(into) == 2 * on) return false;
    if (a.size() + b.size() - 2 - common > kMostNeighbours) return false;
    return std::all_of(around_[from].begin(), around_[from].end(), [&](Index t) {
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

  // The third corners of the triangles on an edge, of which there are at most two.
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

  // Merges at most `most` vertices, none next to another; returns how many.
  std::size_t pass(std::size_t most) {
    std::vector<Merge> merges(positions_.size());
    parallel_for(merges.size(), kVerticesPerTask, [&](std::size_t begin, std::size_t end) {
      for (std::size_t v = begin; v < end; ++v) merges[v] = cheapest(static_cast<Index>(v));
    });
    std::erase_if(merges, [](const Merge& merge) { return merge.from == kNoIndex; });
    std::sort(merges.begin(), merges.end(), [](const Merge& a, const Merge& b) {
      return a.cost < b.cost || (a.cost == b.cost && a.from < b.from);
    });
    const std::size_t tried = std::max<std::size_t>(merges.size() / kCandidatesPerPass, 1);
    std::vector<char> is_taken(positions_.size(), 0);
    std::vector<char> loses(positions_.size(), 0);  // a triangle, in this pass
    std::size_t merged = 0;
    // Of the others only where few of the cheapest may.
    const auto goes_on = [&](std::size_t k) {
      return merged < most && (k < tried || kSmallPass / 2 * merged < merges.size());
    };
    CancelCheck check;
    for (std::size_t k = 0; k < merges.size() && goes_on(k); ++k) {
      check();
      const auto [cost, from, into] = merges[k];
      if (is_taken[from] != 0 || !may_merge(from, into)) continue;
      const auto beside = corners_beside(from, into);
      if (std::any_of(beside.begin(), beside.end(), [&](Index v) {
            return v != kNoIndex && (loses[v] != 0 || around_.size(v) < 2);
          })) {
        continue;
      }
      for (const Index v : beside) {
        if (v != kNoIndex) loses[v] = 1;
      }
      for (const Index j : rings_[from]) is_taken[j] = 1;
      merge(from, into);
      ++merged;
    }
    std::erase_if(triangles_,
                  [](const Triangle& t) { return t[0] == t[1] || t[1] == t[2] || t[2] == t[0]; });
    return merged;
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

  Decimated result() {
    Decimated result;
    const std::size_t n = positions_.size();
    std::vector<Index> own(n, kNoIndex);
    for (Index v = 0; v < n; ++v) {
      if (around_.size(v) == 0) continue;
      own[v] = static_cast<Index>(result.kept.size());
      result.kept.push_back(v);
    }
    result.owners.resize(n);
    for (Index v = 0; v < n; ++v) {
      Index last = v;
      while (owners_[last] != last) last = owners_[last];
      result.owners[v] = own[last];
    }
    result.triangles = std::move(triangles_);
    for (Triangle& t : result.triangles) {
      for (Index& corner : t) corner = own[corner];
    }
    return result;
  }

  std::span<const Vector3d> positions_;
  std::span<const Index> groups_;
  std::vector<Triangle> triangles_;
  std::vector<Index> owners_;  ///< per vertex: what it went into, itself where it is left
  std::vector<Quadric> quadrics_;
  Adjacency around_;
  Adjacency rings_;
};

}  // namespace

Decimated decimate(std::span<const Vector3d> positions, std::vector<Triangle> triangles,
                   std::span<const Index> groups, std::size_t count) {
  return Decimation(positions, std::move(triangles), groups).run(count);
}

}  // namespace lapwing
