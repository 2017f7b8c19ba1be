#pragma once

#include <cstddef>
#include <set>
#include <span>
#include <vector>

#include <Eigen/Core>

#include "lapwing/mesh/point_tree.h"

namespace lapwing {

/// Returns twice the signed area of the triangle a, b, c, positive if it turns left.
double orient(const Eigen::Vector2d& a, const Eigen::Vector2d& b, const Eigen::Vector2d& c);

/// Triangulates a polygon of the plane by ear clipping. An ear is a corner that turns left and
/// whose triangle with its neighbours contains no other corner. Ears are clipped in the order of
/// their corners; the lowest remaining corner is clipped only if it is the only ear. If a
/// self-intersecting polygon has no ear, the second remaining corner is clipped, so that the
/// algorithm always ends.
///
/// A corner is tested again only after a neighbour was removed, or all corners at the point found
/// in its triangle. A tree finds the points in a triangle, so the cost is mostly O(n log n). If a
/// polygon uses up some thousand tests per corner, which only self-intersecting ones do, the rest
/// is cut off corner by corner.
class EarClipper {
 public:
  /// `plane` must have at least 3 corners and outlive the object.
  explicit EarClipper(std::span<const Eigen::Vector2d> plane);

  /// Calls `add(a, b, c)` with the corners of each triangle. Throws Cancelled.
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

  std::span<const Eigen::Vector2d> plane_;
  std::vector<std::size_t> before_;
  std::vector<std::size_t> after_;
  std::vector<std::size_t> point_of_;              // per corner: index into points_
  std::vector<Eigen::Vector2d> points_;            // distinct positions of the corners
  std::vector<std::size_t> corners_at_;            // per point: number of corners left
  std::vector<std::size_t> blocker_;               // per corner: the point found in its triangle
  std::vector<std::vector<std::size_t>> waiting_;  // per point: the corners it blocks
  std::set<std::size_t> ears_;
  PointTree tree_;
  std::size_t first_ = 0;
  std::size_t left_;
  std::size_t looks_;  // tests of points and boxes still allowed
};

}  // namespace lapwing
