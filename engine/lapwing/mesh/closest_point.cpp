// Closest point on a triangle: Ericson, "Real-Time Collision Detection", 2005, section 5.1.5.
#include "lapwing/mesh/closest_point.h"

#include <algorithm>
#include <limits>
#include <numeric>
#include <utility>

#include <Eigen/Geometry>

#include "lapwing/base/cancellation.h"

namespace lapwing {

namespace {

using Eigen::Vector3d;

constexpr Index kLeafSize = 4;
// More triangles than this take longer to halve than a cancellation check.
constexpr Index kSlowToHalve = 1000;

// Returns the share of the way from `a` to `b` of the point closest to `point`, in [0, 1].
double closest_on_segment(const Vector3d& a, const Vector3d& b, const Vector3d& point) {
  const Vector3d along = b - a;
  const double length2 = along.squaredNorm();
  return length2 > 0.0 ? std::clamp((point - a).dot(along) / length2, 0.0, 1.0) : 0.0;
}

Vector3d combine(const std::array<Vector3d, 3>& corners, const std::array<double, 3>& weights) {
  return weights[0] * corners[0] + weights[1] * corners[1] + weights[2] * corners[2];
}

double box_distance2(const Vector3d& min, const Vector3d& max, const Vector3d& point) {
  return (min - point).cwiseMax(point - max).cwiseMax(0.0).squaredNorm();
}

// A ray with the inverse of its direction, for box tests.
struct Ray {
  Vector3d origin;
  Vector3d direction;
  Vector3d inverse;

  // Returns whether it meets the box before `end`.
  bool meets(const Vector3d& min, const Vector3d& max, double end) const {
    double begin = 0.0;
    for (Eigen::Index axis = 0; axis < 3; ++axis) {
      double in = (min[axis] - origin[axis]) * inverse[axis];
      double out = (max[axis] - origin[axis]) * inverse[axis];
      if (in > out) std::swap(in, out);
      // NaN if the origin is on a side of the box parallel to the ray; then neither holds.
      if (in > begin) begin = in;
      if (out < end) end = out;
    }
    return begin <= end;
  }
};

Adjacency one_group(std::size_t count) {
  Adjacency groups;
  groups.values.resize(count);
  std::iota(groups.values.begin(), groups.values.end(), Index{0});
  groups.starts.push_back(static_cast<Index>(count));
  return groups;
}

}  // namespace

std::array<double, 3> closest_weights(const std::array<Vector3d, 3>& corners,
                                      const Vector3d& point) {
  const auto& [a, b, c] = corners;
  const Vector3d normal = (b - a).cross(c - a);
  const double area2 = normal.squaredNorm();
  const double wa = (b - point).cross(c - point).dot(normal);
  const double wb = (c - point).cross(a - point).dot(normal);
  const double wc = (a - point).cross(b - point).dot(normal);
  if (area2 > 0.0 && wa >= 0.0 && wb >= 0.0 && wc >= 0.0) {
    const double sum = wa + wb + wc;
    if (sum > 0.0) return {wa / sum, wb / sum, wc / sum};
  }
  std::array<double, 3> best{1.0, 0.0, 0.0};
  double best_distance2 = std::numeric_limits<double>::infinity();
  for (std::size_t k = 0; k < 3; ++k) {
    const std::size_t l = (k + 1) % 3;
    const double t = closest_on_segment(corners[k], corners[l], point);
    const double distance2 = (corners[k] + t * (corners[l] - corners[k]) - point).squaredNorm();
    if (distance2 >= best_distance2) continue;
    best_distance2 = distance2;
    best = {0.0, 0.0, 0.0};
    best[k] = 1.0 - t;
    best[l] = t;
  }
  return best;
}

struct ClosestPoint::Search {
  Vector3d point;
  Vector3d direction;
  Index root = 0;
  double best_distance2 = std::numeric_limits<double>::infinity();
  TrianglePoint best;
};

ClosestPoint::ClosestPoint(std::span<const Triangle> triangles, std::span<const Vector3d> positions,
                           const Adjacency& groups) {
  items_.reserve(groups.values.size());
  for (std::size_t g = 0; g < groups.row_count(); ++g) {
    const auto begin = static_cast<Index>(items_.size());
    CancelCheck cancel_check;
    for (const Index t : groups[g]) {
      cancel_check();
      const auto& [a, b, c] = triangles[t];
      const std::array corners{positions[a], positions[b], positions[c]};
      items_.push_back({corners, (corners[1] - corners[0]).cross(corners[2] - corners[0]), t});
    }
    roots_.push_back(build(begin, static_cast<Index>(items_.size())));
  }
}

ClosestPoint::ClosestPoint(std::span<const Triangle> triangles, std::span<const Vector3d> positions)
    : ClosestPoint(triangles, positions, one_group(triangles.size())) {}

// Splits at the median along the longest side of the centroids' box.
Index ClosestPoint::build(Index begin, Index end) {
  const auto number = static_cast<Index>(nodes_.size());
  nodes_.emplace_back();
  Node node;
  node.min.setConstant(std::numeric_limits<double>::infinity());
  node.max = -node.min;
  Vector3d low = node.min;
  Vector3d high = node.max;
  const auto center = [](const Item& item) {
    return Vector3d(item.corners[0] + item.corners[1] + item.corners[2]);
  };
  for (Index i = begin; i < end; ++i) {
    for (const Vector3d& corner : items_[i].corners) {
      node.min = node.min.cwiseMin(corner);
      node.max = node.max.cwiseMax(corner);
    }
    low = low.cwiseMin(center(items_[i]));
    high = high.cwiseMax(center(items_[i]));
  }
  node.begin = begin;
  node.end = end;
  if (end - begin > kLeafSize) {
    if (end - begin > kSlowToHalve) check_cancelled();
    int axis = 0;
    (high - low).maxCoeff(&axis);
    const Index middle = begin + (end - begin) / 2;
    std::nth_element(items_.begin() + begin, items_.begin() + middle, items_.begin() + end,
                     [&](const Item& x, const Item& y) {
                       const double cx = center(x)[axis];
                       const double cy = center(y)[axis];
                       return cx != cy ? cx < cy : x.triangle < y.triangle;
                     });
    build(begin, middle);
    node.second = build(middle, end);
  }
  nodes_[number] = node;
  return number;
}

void ClosestPoint::visit(Search& search) const {
  struct Waiting {
    Index node;
    double distance2;
  };
  std::array<Waiting, 64> stack;  // halving 2^32 items goes 32 deep
  std::size_t waiting = 0;
  const auto push = [&](Index n) {
    const double d = box_distance2(nodes_[n].min, nodes_[n].max, search.point);
    if (d < search.best_distance2) stack[waiting++] = {n, d};
  };
  push(search.root);
  while (waiting > 0) {
    const auto [number, distance2] = stack[--waiting];
    if (distance2 >= search.best_distance2) continue;
    const Node& node = nodes_[number];
    if (node.second != kNoIndex) {
      const std::size_t before = waiting;
      push(number + 1);
      push(node.second);
      if (waiting == before + 2 && stack[before].distance2 < stack[before + 1].distance2) {
        std::swap(stack[before], stack[before + 1]);  // the closer child first
      }
      continue;
    }
    for (Index i = node.begin; i < node.end; ++i) try_item(i, search);
  }
}

void ClosestPoint::try_item(Index number, Search& search) const {
  const Item& item = items_[number];
  if (item.normal.dot(search.direction) < 0.0) return;
  const auto weights = closest_weights(item.corners, search.point);
  const Vector3d position = combine(item.corners, weights);
  const double distance2 = (position - search.point).squaredNorm();
  if (distance2 >= search.best_distance2) return;
  search.best_distance2 = distance2;
  search.best = {item.triangle, weights, position, number};
}

std::vector<TrianglePoint> ClosestPoint::within(Index group, const Vector3d& point,
                                                double distance) const {
  std::vector<TrianglePoint> found;
  std::array<Index, 64> stack;  // halving 2^32 items goes 32 deep
  std::size_t waiting = 0;
  stack[waiting++] = roots_[group];
  while (waiting > 0) {
    const Index number = stack[--waiting];
    const Node& node = nodes_[number];
    if (box_distance2(node.min, node.max, point) > distance * distance) continue;
    if (node.second != kNoIndex) {
      stack[waiting++] = number + 1;
      stack[waiting++] = node.second;
      continue;
    }
    for (Index i = node.begin; i < node.end; ++i) {
      const auto weights = closest_weights(items_[i].corners, point);
      const Vector3d position = combine(items_[i].corners, weights);
      if ((position - point).squaredNorm() > distance * distance) continue;
      found.push_back({items_[i].triangle, weights, position, i});
    }
  }
  return found;
}

TrianglePoint ClosestPoint::find(Index group, const Vector3d& point, const Vector3d& direction,
                                 Index hint) const {
  Search search{point, direction, roots_[group], std::numeric_limits<double>::infinity(), {}};
  if (hint != kNoIndex) try_item(hint, search);
  visit(search);
  if (search.best.triangle == kNoIndex) {
    search.direction.setZero();
    visit(search);
  }
  return search.best;
}

// Ray-triangle test: Moeller and Trumbore, "Fast, Minimum Storage Ray/Triangle Intersection", 1997.
TrianglePoint ClosestPoint::first_exit(Index group, const Vector3d& origin,
                                       const Vector3d& direction, const Vector3d& corner) const {
  const Ray ray{origin, direction, direction.cwiseInverse()};
  TrianglePoint found;
  double nearest = std::numeric_limits<double>::infinity();
  const auto try_triangle = [&](Index number) {
    const auto& [a, b, c] = items_[number].corners;
    if (!(items_[number].normal.dot(direction) > 0.0)) return;
    if (a == corner || b == corner || c == corner) return;
    const Vector3d across = direction.cross(c - a);
    const double determinant = (b - a).dot(across);
    const Vector3d from = origin - a;
    const Vector3d along = from.cross(b - a);
    const double u = from.dot(across) / determinant;
    const double v = direction.dot(along) / determinant;
    const double t = (c - a).dot(along) / determinant;
    if (!(u >= 0.0 && v >= 0.0 && u + v <= 1.0 && t > 0.0 && t < nearest)) return;
    nearest = t;
    const std::array weights{1.0 - u - v, u, v};
    found = {items_[number].triangle, weights, combine(items_[number].corners, weights), number};
  };
  std::array<Index, 64> stack;  // halving 2^32 items goes 32 deep
  std::size_t waiting = 0;
  stack[waiting++] = roots_[group];
  while (waiting > 0) {
    const Index number = stack[--waiting];
    const Node& node = nodes_[number];
    if (!ray.meets(node.min, node.max, nearest)) continue;
    if (node.second != kNoIndex) {
      stack[waiting++] = node.second;
      stack[waiting++] = number + 1;
      continue;
    }
    for (Index i = node.begin; i < node.end; ++i) try_triangle(i);
  }
  return found;
}

}  // namespace lapwing
