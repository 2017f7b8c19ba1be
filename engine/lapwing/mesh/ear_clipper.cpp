#include "lapwing/mesh/ear_clipper.h"

#include <algorithm>
#include <limits>
#include <numeric>
#include <utility>

#include "lapwing/base/cancellation.h"

namespace lapwing {

using Eigen::AlignedBox2d;
using Eigen::Vector2d;

namespace {

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

}  // namespace

double orient(const Vector2d& a, const Vector2d& b, const Vector2d& c) {
  return (b.x() - a.x()) * (c.y() - a.y()) - (b.y() - a.y()) * (c.x() - a.x());
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

}  // namespace lapwing
