#pragma once

#include <array>
#include <vector>

#include "lapwing/transplant/bridge.h"
#include "lapwing/transplant/bridge_path.h"

namespace lapwing::bridging {

/// A loop, taken forwards or backwards, with the normals of the surface behind its edges and all
/// edges between its vertices. Numbers are places in the direction taken.
class RimLoop {
 public:
  RimLoop(const BridgeLoop& loop, bool backwards);

  std::size_t size() const { return points_.size(); }
  const Positions& points() const { return points_; }
  /// The loop's edges and chords, sorted, each with the lower number first.
  const std::vector<std::array<Index, 2>>& edges() const { return edges_; }
  bool has_edge(std::size_t a, std::size_t b) const;
  /// Returns whether the edge of the loop that starts at `a` ends at `b`.
  bool leads(std::size_t a, std::size_t b) const { return (a + 1) % size() == b; }
  /// Returns the place in the loop as it was given.
  Index original(std::size_t place) const;
  /// Returns `count` edges from `first` on, wrapping around at the loop's end.
  Chain chain(std::size_t first, std::size_t count) const;

 private:
  bool backwards_;
  Positions points_;
  std::vector<Eigen::Vector3d> normals_;  // of the surface behind edge k -> k + 1
  std::vector<std::array<Index, 2>> edges_;
};

/// A rung that the strip must contain.
struct Node {
  Index host = 0, part = 0;
  bool welded = false;  ///< its ends are one vertex
};

/// A strip around both loops as steps from the first node on.
struct BridgeStrip {
  std::vector<Node> nodes;
  std::vector<Step> steps;
  double cost = 0.0;
  std::vector<std::size_t>
      blocked;  ///< nodes whose gap to the next one cannot be closed; if any, there is no strip
};

/// Finds the cheapest strip of triangles between two loops with the same direction that passes
/// through given nodes.
class BridgeSolver {
 public:
  /// Keeps references to both loops.
  BridgeSolver(const RimLoop& host, const RimLoop& part) : host_(host), part_(part) {}
  const RimLoop& host() const { return host_; }
  const RimLoop& part() const { return part_; }

  /// Returns the cheapest strip through `nodes`, one or more in order around both loops.
  BridgeStrip solve(std::vector<Node> nodes) const;

  /// Returns the cheapest strip through `node` and the rung half way around both loops from it. In
  /// this strip no vertex is the apex of all triangles on the other loop.
  BridgeStrip solve_with_second_rung(const Node& node) const;

  /// Returns the triangles as in Bridge. `strip` must not be blocked.
  std::vector<Triangle> triangles(const BridgeStrip& strip) const;

 private:
  Gap gap_after(const std::vector<Node>& nodes, std::size_t k) const;
  void forbid_repeated_edges(Gap& gap, const Node& start, const Node& end) const;

  const RimLoop& host_;
  const RimLoop& part_;
};

}  // namespace lapwing::bridging
