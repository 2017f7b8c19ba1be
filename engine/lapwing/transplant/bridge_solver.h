#pragma once

#include <array>
#include <vector>

#include "lapwing/transplant/bridge.h"
#include "lapwing/transplant/bridge_path.h"

namespace lapwing::bridging {

/// A loop, forwards or backwards, with the normals of the triangles at its edges and all edges
/// between its vertices. Indices are positions in the chosen direction.
class RimLoop {
 public:
  RimLoop(const BridgeLoop& loop, bool backwards);

  std::size_t size() const { return points_.size(); }
  const Positions& points() const { return points_; }
  /// Returns the loop's edges and chords, sorted, each with the lower index first.
  const std::vector<std::array<Index, 2>>& edges() const { return edges_; }
  bool has_edge(std::size_t a, std::size_t b) const;
  /// Returns whether `b` follows `a` in the loop.
  bool leads(std::size_t a, std::size_t b) const { return (a + 1) % size() == b; }
  /// Returns the position in the BridgeLoop.
  Index original(std::size_t place) const;
  /// Returns `count` edges from `first` on, wrapping around at the loop's end.
  Chain chain(std::size_t first, std::size_t count) const;

 private:
  bool backwards_;
  Positions points_;
  std::vector<Eigen::Vector3d> normals_;  // of the triangle at edge k -> k + 1
  std::vector<std::array<Index, 2>> edges_;
};

/// A rung that the strip must contain.
struct Node {
  Index host = 0, part = 0;
  bool welded = false;  ///< whether its ends are merged
};

/// A strip around both loops, as steps that start at the first node.
struct BridgeStrip {
  std::vector<Node> nodes;
  std::vector<Step> steps;
  double cost = 0.0;
  std::vector<std::size_t>
      /// Indices of nodes whose gap to the next node cannot be closed; if not empty, there is no
      /// strip.
      blocked;
};

/// Finds the cheapest strip of triangles through given nodes between two loops with the same
/// direction.
class BridgeSolver {
 public:
  /// Both loops must outlive the object.
  BridgeSolver(const RimLoop& host, const RimLoop& part) : host_(host), part_(part) {}
  const RimLoop& host() const { return host_; }
  const RimLoop& part() const { return part_; }

  /// Returns the cheapest strip through all `nodes` (at least one), in the order of both loops.
  BridgeStrip solve(std::vector<Node> nodes) const;

  /// Returns the cheapest strip through `node` and the rung opposite to it on both loops. In this
  /// strip, no vertex is the apex of all triangles on the other loop.
  BridgeStrip solve_with_second_rung(const Node& node) const;

  /// Returns Bridge::triangles. `strip.blocked` must be empty.
  std::vector<Triangle> triangles(const BridgeStrip& strip) const;

 private:
  Gap gap_after(const std::vector<Node>& nodes, std::size_t k) const;
  void forbid_repeated_edges(Gap& gap, const Node& start, const Node& end) const;

  const RimLoop& host_;
  const RimLoop& part_;
};

}  // namespace lapwing::bridging
