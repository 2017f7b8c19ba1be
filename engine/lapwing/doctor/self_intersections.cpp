#include "lapwing/doctor/self_intersections.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

#include <Eigen/Geometry>

#include "lapwing/base/cancellation.h"
#include "lapwing/base/errors.h"
#include "lapwing/base/limits.h"

namespace lapwing {
namespace {

using Eigen::Vector3d;
using Corners = std::array<const Vector3d*, 3>;

// Bounds on the relative error of the two determinants (Shewchuk 1997), increased to cover terms of
// second order.
template <class Real>
constexpr Real kVolumeError = Real(8) * std::numeric_limits<Real>::epsilon();
template <class Real>
constexpr Real kAreaError = Real(4) * std::numeric_limits<Real>::epsilon();

// Returns the sign of the volume, 1 or -1, if it is certain, otherwise 0.
template <class Real>
int volume_sign(const Vector3d& a, const Vector3d& b, const Vector3d& c, const Vector3d& d) {
  using Vector = Eigen::Matrix<Real, 3, 1>;
  const Vector origin = d.cast<Real>();
  const Vector u = a.cast<Real>() - origin;
  const Vector v = b.cast<Real>() - origin;
  const Vector w = c.cast<Real>() - origin;
  Real sum = 0;
  Real size = 0;
  for (Eigen::Index k = 0; k < 3; ++k) {
    const Eigen::Index l = (k + 1) % 3;
    const Eigen::Index m = (k + 2) % 3;
    sum += u[k] * (v[l] * w[m] - v[m] * w[l]);
    size += std::abs(u[k]) * (std::abs(v[l] * w[m]) + std::abs(v[m] * w[l]));
  }
  if (std::abs(sum) <= kVolumeError<Real> * size) return 0;
  return sum > 0 ? 1 : -1;
}

// Returns the side, 1 or -1, of the plane of a, b, c on which d is, or 0 if this is uncertain.
int side_of_plane(const Vector3d& a, const Vector3d& b, const Vector3d& c, const Vector3d& d) {
  const int sign = volume_sign<double>(a, b, c, d);
  return sign != 0 ? sign : volume_sign<long double>(a, b, c, d);
}

// The two axes of a coordinate plane.
struct Plane {
  Eigen::Index x, y;
};

// Returns the coordinate plane in which the projection of a triangle is largest.
Plane plane_of(const Corners& t) {
  Eigen::Index axis = 0;
  (*t[1] - *t[0]).cross(*t[2] - *t[0]).cwiseAbs().maxCoeff(&axis);
  return {(axis + 1) % 3, (axis + 2) % 3};
}

// Returns the side, 1 or -1, of the line from a to b on which c is, or 0 if this is uncertain.
int side_of_line(const Vector3d& a, const Vector3d& b, const Vector3d& c, const Plane& plane) {
  using Real = long double;
  const auto [x, y] = plane;
  const Real left = (Real(a[x]) - Real(c[x])) * (Real(b[y]) - Real(c[y]));
  const Real right = (Real(a[y]) - Real(c[y])) * (Real(b[x]) - Real(c[x]));
  const Real difference = left - right;
  if (std::abs(difference) <= kAreaError<Real> * (std::abs(left) + std::abs(right))) return 0;
  return difference > 0 ? 1 : -1;
}

bool overlap(double a, double b, double c, double d) {
  return std::max(std::min(a, b), std::min(c, d)) <= std::min(std::max(a, b), std::max(c, d));
}

// Returns whether two closed segments in one plane have a common point.
bool segments_meet(const Vector3d& p, const Vector3d& q, const Vector3d& a, const Vector3d& b,
                   const Plane& plane) {
  return side_of_line(p, q, a, plane) * side_of_line(p, q, b, plane) <= 0 &&
         side_of_line(a, b, p, plane) * side_of_line(a, b, q, plane) <= 0 &&
         overlap(p[plane.x], q[plane.x], a[plane.x], b[plane.x]) &&
         overlap(p[plane.y], q[plane.y], a[plane.y], b[plane.y]);
}

bool all_on_one_side(int a, int b, int c) {
  return (a >= 0 && b >= 0 && c >= 0) || (a <= 0 && b <= 0 && c <= 0);
}

// Returns whether a closed segment and a closed triangle have a common point.
bool segment_meets(const Vector3d& p, const Vector3d& q, const Corners& t) {
  const int at_p = side_of_plane(*t[0], *t[1], *t[2], p);
  const int at_q = side_of_plane(*t[0], *t[1], *t[2], q);
  if (at_p * at_q > 0) return false;
  if (at_p != 0 || at_q != 0) {
    return all_on_one_side(side_of_plane(p, q, *t[0], *t[1]), side_of_plane(p, q, *t[1], *t[2]),
                           side_of_plane(p, q, *t[2], *t[0]));
  }
  const Plane plane = plane_of(t);
  for (std::size_t k = 0; k < 3; ++k) {
    if (segments_meet(p, q, *t[k], *t[(k + 1) % 3], plane)) return true;
  }
  return all_on_one_side(side_of_line(*t[0], *t[1], p, plane), side_of_line(*t[1], *t[2], p, plane),
                         side_of_line(*t[2], *t[0], p, plane));
}

bool side_meets(const Corners& of, std::size_t side, const Corners& t) {
  return segment_meets(*of[side], *of[(side + 1) % 3], t);
}

class Finder {
 public:
  Finder(std::span<const Triangle> triangles, std::span<const Vector3d> positions)
      : triangles_(triangles), positions_(positions) {
    for (Index t = 0; t < triangles.size(); ++t) {
      const Corners c = corners(t);
      const double area = (*c[1] - *c[0]).cross(*c[2] - *c[0]).squaredNorm();
      if (area > 0.0 && std::isfinite(area)) items_.push_back(t);
    }
    boxes_.resize(triangles.size());
    for (const Index t : items_) {
      for (const Vector3d* corner : corners(t)) boxes_[t].extend(*corner);
    }
    if (!items_.empty()) build(0, items_.size());
    most_pairs_ =
        std::max(limit_value(kMostPairs), kPairsOfTriangle * static_cast<double>(items_.size()));
  }

  std::vector<std::array<Index, 2>> run() {
    for (const Index t : items_) search(t);
    std::ranges::sort(pairs_);
    return std::move(pairs_);
  }

 private:
  using Box = Eigen::AlignedBox3d;
  struct Node {
    Box box;
    std::size_t begin = 0, end = 0;  // range in items_
    std::size_t second = 0;          // second child, 0 in a leaf; the first child follows
  };
  static constexpr std::size_t kLeaf = 8;

  Corners corners(Index t) const {
    const auto& [a, b, c] = triangles_[t];
    return {&positions_[a], &positions_[b], &positions_[c]};
  }

  std::size_t build(std::size_t begin, std::size_t end) {
    const std::size_t number = nodes_.size();
    nodes_.emplace_back();
    Box box;
    for (std::size_t k = begin; k < end; ++k) box.extend(boxes_[items_[k]]);
    nodes_[number] = {box, begin, end, 0};
    if (end - begin <= kLeaf) return number;
    Eigen::Index axis = 0;
    box.sizes().maxCoeff(&axis);
    const std::size_t middle = begin + (end - begin) / 2;
    const auto at = [&](std::size_t k) { return items_.begin() + static_cast<std::ptrdiff_t>(k); };
    std::nth_element(at(begin), at(middle), at(end), [&](Index a, Index b) {
      const double at_a = boxes_[a].min()[axis] + boxes_[a].max()[axis];
      const double at_b = boxes_[b].min()[axis] + boxes_[b].max()[axis];
      return std::pair(at_a, a) < std::pair(at_b, b);
    });
    build(begin, middle);
    const std::size_t second = build(middle, end);
    nodes_[number].second = second;
    return number;
  }

  void search(Index t) {
    std::vector<std::size_t> open{0};
    while (!open.empty()) {
      cancel_check_();
      const std::size_t number = open.back();
      const Node& node = nodes_[number];
      open.pop_back();
      if (!node.box.intersects(boxes_[t])) continue;
      if (node.second != 0) {
        open.push_back(node.second);
        open.push_back(number + 1);
        continue;
      }
      for (std::size_t k = node.begin; k < node.end; ++k) {
        const Index other = items_[k];
        if (other <= t || !boxes_[other].intersects(boxes_[t])) continue;
        count_pair();
        if (meet(t, other)) pairs_.push_back({t, other});
      }
    }
  }

  void count_pair() {
    cancel_check_();
    if (++compared_ <= most_pairs_) return;
    throw InputError(
        "the boxes of the " + std::to_string(items_.size()) + " triangles overlap in more than " +
        std::to_string(static_cast<long long>(most_pairs_)) +
        " pairs, the limit for comparing them. Remove repeated faces with `lapwing check MESH "
        "--fix OUT`, split fans of very many triangles, or set " +
        kMostPairs.variable + " to a larger number");
  }

  // Permutes both triangles so that their shared corners come first. Returns the number of shared
  // corners.
  std::size_t line_up(Triangle& a, Triangle& b) const {
    std::size_t shared = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      const auto same = std::find(b.begin() + static_cast<std::ptrdiff_t>(shared), b.end(), a[k]);
      if (same == b.end()) continue;
      std::swap(b[shared], *same);
      std::swap(a[shared], a[k]);
      ++shared;
    }
    return shared;
  }

  bool meet(Index first, Index second) const {
    Triangle a = triangles_[first];
    Triangle b = triangles_[second];
    const std::size_t shared = line_up(a, b);
    const Corners s{&positions_[a[0]], &positions_[a[1]], &positions_[a[2]]};
    const Corners t{&positions_[b[0]], &positions_[b[1]], &positions_[b[2]]};
    if (shared == 3) return true;
    if (shared == 2) {
      if (side_of_plane(*s[0], *s[1], *s[2], *t[2]) != 0) return false;
      const Plane plane = plane_of(s);
      return side_of_line(*s[0], *s[1], *s[2], plane) * side_of_line(*s[0], *s[1], *t[2], plane) >
             0;
    }
    if (shared == 1) return side_meets(s, 1, t) || side_meets(t, 1, s);
    for (std::size_t k = 0; k < 3; ++k) {
      if (side_meets(s, k, t) || side_meets(t, k, s)) return true;
    }
    return false;
  }

  std::span<const Triangle> triangles_;
  std::span<const Vector3d> positions_;
  std::vector<Index> items_;
  std::vector<Box> boxes_;  // per triangle
  std::vector<Node> nodes_;
  std::vector<std::array<Index, 2>> pairs_;
  double most_pairs_ = 0.0;
  double compared_ = 0.0;
  CancelCheck cancel_check_;
};

}  // namespace

std::vector<std::array<Index, 2>> self_intersections(std::span<const Triangle> triangles,
                                                     std::span<const Vector3d> positions) {
  return Finder(triangles, positions).run();
}

}  // namespace lapwing
