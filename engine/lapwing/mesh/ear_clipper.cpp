#include "lapwing/mesh/ear_clipper.h"

#include <algorithm>
#include <iterator>

#include "lapwing/base/cancellation.h"

namespace lapwing {

using Eigen::AlignedBox2d;
using Eigen::Vector2d;

namespace {

// More than any polygon needs that does not cut through itself, and all that 64 corners can take.
constexpr std::size_t kLooksPerCorner = 64;
constexpr std::size_t kLooksAtLeast = 4096;

// Far more than `orient` is off by rounding, as a share of the squared size of what it is given.
constexpr double kOrientError = 1e-12;

// Whether all of the box is to the right of the line from a to b, beyond rounding.
bool is_right_of(const AlignedBox2d& box, const Vector2d& a, const Vector2d& b) {
  const Vector2d along = b - a;
  // The corner that is farthest to the left.
  const Vector2d corner(along.y() < 0.0 ? box.max().x() : box.min().x(),
                        along.x() < 0.0 ? box.min().y() : box.max().y());
  const double size = along.norm() * (along.norm() + (corner - a).norm());
  return orient(a, b, corner) < -kOrientError * size;
}

}  // namespace

double orient(const Vector2d& a, const Vector2d& b, const Vector2d& c) {
  return (b.x() - a.x()) * (c.y() - a.y()) - (b.y() - a.y()) * (c.x() - a.x());
}

EarClipper::EarClipper(std::span<const Vector2d> plane)
    : plane_(plane),
      before_(plane.size()),
      after_(plane.size()),
      blocker_(plane.size(), plane.size()),
      waiting_(plane.size()),
      tree_(plane),
      left_(plane.size()),
      looks_left_(kLooksPerCorner * plane.size() + kLooksAtLeast) {
  const std::size_t n = plane.size();
  for (std::size_t i = 0; i < n; ++i) {
    before_[i] = (i + n - 1) % n;
    after_[i] = (i + 1) % n;
  }
  CancelCheck cancel_check;
  for (std::size_t i = 0; i < n; ++i) {
    cancel_check();
    look_at(i);
  }
}

// Corners keep their order, so that the first one left has the lowest number.
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
  tree_.take_out(corner);
  --left_;
  look_at(before);
  look_at(after);
  const std::vector<std::size_t> waiting = std::move(waiting_[corner]);
  for (const std::size_t other : waiting) {
    if (other != corner && blocker_[other] == corner) look_at(other);
  }
  blocker_[corner] = plane_.size();
}

void EarClipper::look_at(std::size_t corner) {
  ears_.erase(corner);
  blocker_[corner] = plane_.size();
  if (looks_left_ == 0) return;
  --looks_left_;
  if (!(orient(plane_[before_[corner]], plane_[corner], plane_[after_[corner]]) > 0.0)) return;
  const std::size_t blocker = blocker_of(corner);
  blocker_[corner] = blocker;
  if (blocker == plane_.size()) {
    ears_.insert(corner);
  } else {
    waiting_[blocker].push_back(corner);
  }
}

// A corner in the triangle of an ear; their number where there is none. One at the same point, as
// where a bridge to a hole comes back, is no obstacle.
std::size_t EarClipper::blocker_of(std::size_t corner) const {
  const Vector2d& a = plane_[before_[corner]];
  const Vector2d& b = plane_[corner];
  const Vector2d& c = plane_[after_[corner]];
  const auto is_inside = [&](std::size_t i) {
    const Vector2d& p = plane_[i];
    if (p == a || p == b || p == c) return false;
    return orient(a, b, p) >= 0.0 && orient(b, c, p) >= 0.0 && orient(c, a, p) >= 0.0;
  };
  return tree_.find(is_inside, [&](const AlignedBox2d& box) {
    return !is_right_of(box, a, b) && !is_right_of(box, b, c) && !is_right_of(box, c, a);
  });
}

}  // namespace lapwing
