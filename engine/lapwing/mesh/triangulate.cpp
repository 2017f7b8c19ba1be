#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <set>
#include <utility>
#include <vector>

#include <Eigen/Geometry>

#include "lapwing/base/cancellation.h"
#include "lapwing/mesh/topology.h"

namespace lapwing {
namespace {

using Eigen::AlignedBox2d;
using Eigen::Vector2d;
using Eigen::Vector3d;

// Returns twice the signed area of the triangle a, b, c. It is positive if they are
// counterclockwise.
double orient(const Vector2d& a, const Vector2d& b, const Vector2d& c) {
  return (b.x() - a.x()) * (c.y() - a.y()) - (b.y() - a.y()) * (c.x() - a.x());
}

// A k-d tree of points in the plane from which single points can be removed.
class PointTree {
 public:
  // Builds the tree in O(n log n). `points` must outlive it.
  explicit PointTree(std::span<const Vector2d> points);

  void take_out(std::size_t point);

  // Returns a remaining point for which `holds(point)` is true, or the number of all points if none
  // exists. Searches only boxes for which `may_hold(box)` is true. The same points always give the
  // same result.
  template <typename Holds, typename MayHold>
  std::size_t find(const Holds& holds, const MayHold& may_hold) const {
    std::vector<std::size_t> open{0};
    while (!open.empty()) {
      const std::size_t number = open.back();
      const Node& node = nodes_[number];
      open.pop_back();
      if (node.count == 0 || !may_hold(node.box)) continue;
      if (node.second != 0) {
        open.push_back(node.second);
        open.push_back(number + 1);
        continue;
      }
      for (std::size_t k = node.begin; k < node.end; ++k) {
        if (is_there_[items_[k]] != 0 && holds(items_[k])) return items_[k];
      }
    }
    return points_.size();
  }

 private:
  struct Node {
    AlignedBox2d box;
    std::size_t begin = 0, end = 0;  // range in items_
    std::size_t count = 0;           // points not taken out
    std::size_t second = 0;          // second child, 0 in a leaf; the first is the next node
    std::size_t parent = 0;
  };

  std::size_t build(std::size_t begin, std::size_t end, std::size_t parent);

  std::span<const Vector2d> points_;
  std::vector<std::size_t> items_;
  std::vector<std::size_t> leaf_of_;
  std::vector<char> is_there_;
  std::vector<Node> nodes_;
};

constexpr std::size_t kPointsOfLeaf = 8;

PointTree::PointTree(std::span<const Vector2d> points)
    : points_(points),
      items_(points.size()),
      leaf_of_(points.size(), 0),
      is_there_(points.size(), 1) {
  std::iota(items_.begin(), items_.end(), std::size_t{0});
  build(0, items_.size(), 0);
}

// Splits at the median along the longer side of the box.
std::size_t PointTree::build(std::size_t begin, std::size_t end, std::size_t parent) {
  const std::size_t number = nodes_.size();
  AlignedBox2d box;
  for (std::size_t k = begin; k < end; ++k) box.extend(points_[items_[k]]);
  nodes_.push_back({box, begin, end, end - begin, 0, parent});
  if (end - begin <= kPointsOfLeaf) {
    for (std::size_t k = begin; k < end; ++k) leaf_of_[items_[k]] = number;
    return number;
  }
  Eigen::Index axis = 0;
  box.sizes().maxCoeff(&axis);
  const std::size_t middle = begin + (end - begin) / 2;
  const auto at = [&](std::size_t k) { return items_.begin() + static_cast<std::ptrdiff_t>(k); };
  std::nth_element(at(begin), at(middle), at(end), [&](std::size_t a, std::size_t b) {
    return std::pair(points_[a][axis], a) < std::pair(points_[b][axis], b);
  });
  build(begin, middle, number);
  const std::size_t second = build(middle, end, number);
  nodes_[number].second = second;
  return number;
}

void PointTree::take_out(std::size_t point) {
  is_there_[point] = 0;
  for (std::size_t node = leaf_of_[point];; node = nodes_[node].parent) {
    --nodes_[node].count;
    if (node == 0) return;
  }
}

// Triangulates a polygon in the plane by ear clipping. An ear is a convex corner whose triangle
// with its neighbours contains no other corner. The algorithm clips ears in the order of their
// corners. It clips the first remaining corner only if no other ear exists. A self-intersecting
// polygon may have no ear. The algorithm then clips the second remaining corner, so that it always
// terminates.
//
// A point in the triangle of a corner blocks that corner. The algorithm tests a corner again only
// after a neighbour is removed, or after all corners at the blocking point are removed. A k-d tree
// finds the blocking point, so the cost is usually O(n log n). The number of tests is limited. Only
// self-intersecting polygons exceed the limit. For these, the algorithm clips the remaining corners
// without further tests.
class EarClipper {
 public:
  // `plane` contains the corners of the polygon, at least 3. It must outlive the object.
  explicit EarClipper(std::span<const Vector2d> plane);

  // Calls `add(a, b, c)` with the corners of each triangle. Throws Cancelled.
  template <typename Add>
  void clip(const Add& add) {
    while (left_ > 3) {
      const std::size_t ear = next_ear();
      add(before_[ear], ear, after_[ear]);
      remove(ear);
    }
    add(first_, after_[first_], after_[after_[first_]]);
  }

 private:
  std::size_t next_ear() const;
  void remove(std::size_t corner);
  void look_at(std::size_t corner);
  std::size_t blocker_of(std::size_t corner);

  std::span<const Vector2d> plane_;
  std::vector<std::size_t> before_;
  std::vector<std::size_t> after_;
  std::vector<std::size_t> point_of_;              // per corner: index into points_
  std::vector<Vector2d> points_;                   // distinct positions of the corners
  std::vector<std::size_t> corners_at_;            // per point: number of corners left
  std::vector<std::size_t> blocker_;               // per corner: the point found in its triangle
  std::vector<std::vector<std::size_t>> waiting_;  // per point: the corners it blocks
  std::set<std::size_t> ears_;
  PointTree tree_;
  std::size_t first_ = 0;
  std::size_t left_;
  std::size_t looks_;  // tests of points and boxes still allowed
};

// Budget of tests of points and boxes: more than any simple polygon needs, and enough for every
// polygon of 64 corners.
constexpr std::size_t kLooksPerCorner = 2000;
constexpr std::size_t kLooksAtLeast = 500'000;
constexpr std::size_t kNone = std::numeric_limits<std::size_t>::max();

// Far above the rounding error of `orient`, relative to the squared size of its arguments.
constexpr double kOrientError = 1e-12;

// Returns whether the whole box lies to the right of the line from a to b, beyond rounding.
bool is_right_of(const AlignedBox2d& box, const Vector2d& a, const Vector2d& b) {
  const Vector2d along = b - a;
  // The corner that is farthest to the left.
  const Vector2d corner(along.y() < 0.0 ? box.max().x() : box.min().x(),
                        along.x() < 0.0 ? box.min().y() : box.max().y());
  const double size = along.norm() * (along.norm() + (corner - a).norm());
  return orient(a, b, corner) < -kOrientError * size;
}

// Returns the distinct positions of the corners, and sets `point_of` to the index of each corner's.
std::vector<Vector2d> distinct(std::span<const Vector2d> plane,
                               std::vector<std::size_t>& point_of) {
  std::vector<std::size_t> order(plane.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::sort(order.begin(), order.end(), [&](std::size_t i, std::size_t j) {
    const Vector2d& p = plane[i];
    const Vector2d& q = plane[j];
    return p.x() != q.x() ? p.x() < q.x() : p.y() != q.y() ? p.y() < q.y() : i < j;
  });
  std::vector<Vector2d> points;
  for (const std::size_t corner : order) {
    if (points.empty() || points.back() != plane[corner]) points.push_back(plane[corner]);
    point_of[corner] = points.size() - 1;
  }
  return points;
}

EarClipper::EarClipper(std::span<const Vector2d> plane)
    : plane_(plane),
      before_(plane.size()),
      after_(plane.size()),
      point_of_(plane.size()),
      points_(distinct(plane, point_of_)),
      corners_at_(points_.size(), 0),
      blocker_(plane.size(), kNone),
      waiting_(points_.size()),
      tree_(points_),
      left_(plane.size()),
      looks_(kLooksPerCorner * plane.size() + kLooksAtLeast) {
  const std::size_t n = plane.size();
  for (std::size_t i = 0; i < n; ++i) {
    before_[i] = (i + n - 1) % n;
    after_[i] = (i + 1) % n;
    ++corners_at_[point_of_[i]];
  }
  for (std::size_t i = 0; i < n; ++i) {
    check_cancelled();
    look_at(i);
  }
}

// Corners keep their order, so the first remaining one has the lowest number.
std::size_t EarClipper::next_ear() const {
  auto ear = ears_.begin();
  if (ear != ears_.end() && *ear == first_ && ears_.size() > 1) ++ear;
  return ear != ears_.end() ? *ear : after_[first_];
}

void EarClipper::remove(std::size_t corner) {
  check_cancelled();
  const std::size_t before = before_[corner];
  const std::size_t after = after_[corner];
  after_[before] = after;
  before_[after] = before;
  if (corner == first_) first_ = after;
  ears_.erase(corner);
  blocker_[corner] = kNone;
  --left_;
  const std::size_t point = point_of_[corner];
  if (--corners_at_[point] == 0) tree_.take_out(point);
  look_at(before);
  look_at(after);
  if (corners_at_[point] > 0) return;
  for (const std::size_t other : std::exchange(waiting_[point], {})) {
    if (blocker_[other] == point) look_at(other);
  }
}

void EarClipper::look_at(std::size_t corner) {
  ears_.erase(corner);
  blocker_[corner] = kNone;
  if (looks_ == 0) return;
  if (!(orient(plane_[before_[corner]], plane_[corner], plane_[after_[corner]]) > 0.0)) return;
  blocker_[corner] = blocker_of(corner);
  if (blocker_[corner] == kNone) {
    ears_.insert(corner);
  } else {
    waiting_[blocker_[corner]].push_back(corner);
  }
}

// Returns a point in the triangle of `corner`, or kNone. Points equal to a corner of the triangle,
// as at the bridge to a hole, do not block it.
std::size_t EarClipper::blocker_of(std::size_t corner) {
  const Vector2d& a = plane_[before_[corner]];
  const Vector2d& b = plane_[corner];
  const Vector2d& c = plane_[after_[corner]];
  const auto look = [&] { looks_ -= std::min<std::size_t>(looks_, 1); };
  const auto is_inside = [&](std::size_t point) {
    look();
    const Vector2d& p = points_[point];
    if (p == a || p == b || p == c) return false;
    return orient(a, b, p) >= 0.0 && orient(b, c, p) >= 0.0 && orient(c, a, p) >= 0.0;
  };
  const std::size_t found = tree_.find(is_inside, [&](const AlignedBox2d& box) {
    look();
    return !is_right_of(box, a, b) && !is_right_of(box, b, c) && !is_right_of(box, c, a);
  });
  return found == points_.size() ? kNone : found;
}

// Projects the polygon to its mean plane, counter-clockwise. Newell's normal is the axis that a
// polygon of any shape turns around.
std::vector<Vector2d> project_to_mean_plane(std::span<const Index> polygon,
                                            std::span<const Vector3d> positions) {
  const std::size_t n = polygon.size();
  const Vector3d origin = positions[polygon[0]];
  Vector3d normal = Vector3d::Zero();
  for (std::size_t i = 0; i < n; ++i) {
    const Vector3d a = positions[polygon[i]] - origin;
    const Vector3d b = positions[polygon[(i + 1) % n]] - origin;
    normal += a.cross(b);
  }
  std::vector<Vector2d> plane(n, Vector2d::Zero());
  if (!(normal.norm() > 0.0) || !std::isfinite(normal.norm())) return plane;
  normal.normalize();
  Vector3d u = normal.unitOrthogonal();
  const Vector3d v = normal.cross(u);
  for (std::size_t i = 0; i < n; ++i) {
    const Vector3d p = positions[polygon[i]] - origin;
    plane[i] = {p.dot(u), p.dot(v)};
  }
  return plane;
}

bool fan_is_valid(const std::vector<Vector2d>& plane) {
  for (std::size_t i = 1; i + 1 < plane.size(); ++i) {
    if (!(orient(plane[0], plane[i], plane[i + 1]) > 0.0)) return false;
  }
  return true;
}

}  // namespace

void triangulate_polygon(std::span<const Index> polygon, std::span<const Vector3d> positions,
                         std::vector<Triangle>& triangles) {
  const std::size_t n = polygon.size();
  if (n < 3) return;
  if (n == 3) {
    triangles.push_back({polygon[0], polygon[1], polygon[2]});
    return;
  }
  const auto add = [&](std::size_t a, std::size_t b, std::size_t c) {
    triangles.push_back({polygon[a], polygon[b], polygon[c]});
  };
  const std::vector<Vector2d> plane = project_to_mean_plane(polygon, positions);
  // Ear clipping would cut a convex polygon in the same way.
  if (fan_is_valid(plane)) {
    for (std::size_t i = 1; i + 1 < n; ++i) add(0, i, i + 1);
  } else {
    EarClipper(plane).clip(add);
  }
}

}  // namespace lapwing
