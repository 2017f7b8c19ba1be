#pragma once

#include <array>
#include <span>
#include <vector>

#include <Eigen/Core>

#include "lapwing/mesh/topology.h"

namespace lapwing {

/// Where on a triangle: sum_k weights[k] * corner k.
struct TrianglePoint {
  Index triangle = kNoIndex;
  std::array<double, 3> weights{};
  Eigen::Vector3d position = Eigen::Vector3d::Zero();
  Index hint = kNoIndex;  ///< for the next search close by in the same group
};

/// Finds the closest point on triangles that come in groups; a search looks at one group only. A
/// segment is a triangle (a, b, b). One tree of boxes per group, in one array. Threads may share
/// one.
class ClosestPoint {
 public:
  /// `groups[g]` lists the triangles of group g; no list is empty. O(n log n).
  ClosestPoint(std::span<const Triangle> triangles, std::span<const Eigen::Vector3d> positions,
               const Adjacency& groups);

  /// The closest point to `point` on group `group`. Triangles that look against `direction` are
  /// left out, unless all do: on a thin sheet the other side may be closer. O(log n) mostly, less
  /// with the hint of an answer close by. Of equally close points any, but always the same.
  TrianglePoint find(Index group, const Eigen::Vector3d& point,
                     const Eigen::Vector3d& direction = Eigen::Vector3d::Zero(),
                     Index hint = kNoIndex) const;

  /// Where the ray origin + t direction, t > 0, first meets a triangle of group `group` that looks
  /// along `direction`: where it leaves a solid. No triangle (kNoIndex) if it meets none. Triangles
  /// with `corner` as a corner are left out. O(log n) mostly.
  TrianglePoint first_exit(Index group, const Eigen::Vector3d& origin,
                           const Eigen::Vector3d& direction, const Eigen::Vector3d& corner) const;

  /// The closest point of every triangle of group `group` that is at most `distance` away from
  /// `point`, always in the same order.
  std::vector<TrianglePoint> within(Index group, const Eigen::Vector3d& point,
                                    double distance) const;

 private:
  struct Node {
    Eigen::Vector3d min, max;
    Index begin = 0, end = 0;  ///< of `items_`, in a leaf
    Index second = kNoIndex;   ///< the first child follows its parent; kNoIndex in a leaf
  };
  struct Item {
    std::array<Eigen::Vector3d, 3> corners;
    Eigen::Vector3d normal;  ///< not of unit length
    Index triangle = 0;
  };
  struct Search;

  Index build(Index begin, Index end);
  void visit(Search& search) const;
  void try_item(Index item, Search& search) const;

  std::vector<Item> items_;
  std::vector<Node> nodes_;
  std::vector<Index> roots_;  ///< per group
};

/// The weights of the point of a triangle that is closest to `point`; of any triangle, one without
/// area too.
std::array<double, 3> closest_weights(const std::array<Eigen::Vector3d, 3>& corners,
                                      const Eigen::Vector3d& point);

}  // namespace lapwing
