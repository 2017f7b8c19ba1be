#pragma once

#include <array>
#include <span>
#include <vector>

#include <Eigen/Core>

#include "lapwing/mesh/mesh.h"
#include "lapwing/mesh/topology.h"

namespace lapwing {

/// A point on a triangulated surface: sum_k weights[k] * (position of corners[k]). Weights are at
/// least 0 and sum to 1. For `nowhere()` all weights are 0, and so is every value.
struct SurfacePoint {
  std::array<Index, 3> corners{};
  std::array<double, 3> weights{};

  static SurfacePoint at_vertex(Index v) { return {{v, v, v}, {1.0, 0.0, 0.0}}; }
  static SurfacePoint nowhere() { return {}; }
  bool is_nowhere() const { return weights[0] == 0.0 && weights[1] == 0.0 && weights[2] == 0.0; }

  /// Returns the value at the point, interpolated linearly from `values`, one per vertex.
  template <class Value>
  Value of(std::span<const Value> values) const {
    return Value(weights[0] * values[corners[0]] + weights[1] * values[corners[1]] +
                 weights[2] * values[corners[2]]);
  }
};

/// A point on a triangle: sum_k weights[k] * corner k.
struct TrianglePoint {
  Index triangle = kNoIndex;
  std::array<double, 3> weights{};
  Eigen::Vector3d position = Eigen::Vector3d::Zero();
  Index hint = kNoIndex;  ///< speeds up the next search nearby in the same group
};

/// Finds the closest point on triangles in groups; a search looks at one group only. A segment is a
/// triangle (a, b, b). Each group has a tree of boxes. Threads may share an object.
class ClosestPoint {
 public:
  /// `groups[g]` lists the triangles of group g and is not empty. O(n log n).
  ClosestPoint(std::span<const Triangle> triangles, std::span<const Eigen::Vector3d> positions,
               const Adjacency& groups);
  /// All triangles form group 0.
  ClosestPoint(std::span<const Triangle> triangles, std::span<const Eigen::Vector3d> positions);

  /// Returns the closest point to `point` on group `group`. Skips triangles that face against
  /// `direction` unless all do: on a thin sheet the other side may be closer. Mostly O(log n), less
  /// with the hint of a nearby answer. Among equally close points the choice is arbitrary but
  /// always the same.
  TrianglePoint find(Index group, const Eigen::Vector3d& point,
                     const Eigen::Vector3d& direction = Eigen::Vector3d::Zero(),
                     Index hint = kNoIndex) const;

  /// Returns the first point at which the ray origin + t direction, t > 0, leaves a solid, which is
  /// on a triangle of group `group` that faces along `direction`. Returns no triangle (kNoIndex) if
  /// there is none. Skips triangles with `corner` as a corner. Mostly O(log n).
  TrianglePoint first_exit(Index group, const Eigen::Vector3d& origin,
                           const Eigen::Vector3d& direction, const Eigen::Vector3d& corner) const;

  /// Returns, for every triangle of group `group` at most `distance` away from `point`, its closest
  /// point, always in the same order.
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
    Eigen::Vector3d normal;  ///< not normalized
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

/// Returns the weights of the point of a triangle that is closest to `point`, also for a triangle
/// without area.
std::array<double, 3> closest_weights(const std::array<Eigen::Vector3d, 3>& corners,
                                      const Eigen::Vector3d& point);

}  // namespace lapwing
