#pragma once

#include <cstddef>
#include <set>
#include <span>
#include <vector>

#include <Eigen/Core>

#include "lapwing/mesh/point_tree.h"

namespace lapwing {

/// Twice the signed area of the triangle a, b, c; above 0 where it turns to the left.
double orient(const Eigen::Vector2d& a, const Eigen::Vector2d& b, const Eigen::Vector2d& c);

/// Cuts a polygon of the plane into triangles by clipping ears: corners where it turns to the left
/// and whose triangle with their neighbours holds no other corner. Of the ears there are, the first
/// after the polygon's first corner goes first, that one last. Where a polygon that cuts through
/// itself has no ear, the second corner left is clipped, so that it always ends.
///
/// A corner is looked at again only where a neighbour has gone or the one corner that was found in
/// its triangle, with all at the same point; corners in a triangle are found by a tree. n log n
/// mostly. After some thousand looks at other corners for each one, which no polygon needs that
/// does not cut through itself, what is left is cut off corner by corner.
class EarClipper {
 public:
  /// `plane` has at least 3 corners and outlives the object.
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
  std::vector<std::size_t> point_of_;              // by corner, numbers of points_
  std::vector<Eigen::Vector2d> points_;            // of all corners, without repetition
  std::vector<std::size_t> corners_at_;            // how many are left at each point
  std::vector<std::size_t> blocker_;               // by corner: the point found in its triangle
  std::vector<std::vector<std::size_t>> waiting_;  // by point: the corners it blocks
  std::set<std::size_t> ears_;
  PointTree tree_;
  std::size_t first_ = 0;
  std::size_t left_;
  std::size_t looks_;  // at points and boxes, that may still be taken
};

}  // namespace lapwing
