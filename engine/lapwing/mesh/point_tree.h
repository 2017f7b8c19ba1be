#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include <Eigen/Geometry>

namespace lapwing {

/// A k-d tree of points in the plane, which can be removed one by one.
class PointTree {
 public:
  /// `points` must outlive the tree. O(n log n).
  explicit PointTree(std::span<const Eigen::Vector2d> points);

  void take_out(std::size_t point);

  /// Returns a remaining point for which `holds(point)` is true, or the number of points if there
  /// is none. Searches only boxes for which `may_hold(box)` is true, and stops at the first hit.
  /// The choice depends on the points alone.
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
    Eigen::AlignedBox2d box;
    std::size_t begin = 0, end = 0;  // range in items_
    std::size_t count = 0;           // points not taken out
    std::size_t second = 0;          // second child, 0 in a leaf; the first is the next node
    std::size_t parent = 0;
  };

  std::size_t build(std::size_t begin, std::size_t end, std::size_t parent);

  std::span<const Eigen::Vector2d> points_;
  std::vector<std::size_t> items_;
  std::vector<std::size_t> leaf_of_;
  std::vector<char> is_there_;
  std::vector<Node> nodes_;
};

}  // namespace lapwing
