#pragma once

#include <array>
#include <vector>

#include "lapwing/transplant/zip.h"
#include "lapwing/transplant/zip_path.h"

namespace lapwing::zipping {

/// A loop with the normals behind its edges and its vertices' edges among each other, forwards or
/// taken backwards; numbers are places in the direction taken.
class RimLoop {
 public:
  RimLoop(const ZipLoop& loop, bool backwards);

  std::size_t size() const { return points_.size(); }
  const Positions& points() const { return points_; }
  /// The edges along the loop and the chords; lower number first, ascending.
  const std::vector<std::array<Index, 2>>& edges() const { return edges_; }
  bool has_edge(std::size_t a, std::size_t b) const;
  /// Whether the edge of the loop that starts at `a` ends at `b`.
  bool leads(std::size_t a, std::size_t b) const { return (a + 1) % size() == b; }
  /// The place in the loop as it was given.
  Index original(std::size_t place) const;
  /// `count` edges from `first` on, over the loop's end.
  Chain chain(std::size_t first, std::size_t count) const;

 private:
  bool backwards_;
  Positions points_;
  std::vector<Eigen::Vector3d> normals_;  // of the surface behind edge k -> k + 1
  std::vector<std::array<Index, 2>> edges_;
};

/// A rung that the strip has to pass.
struct Node {
  Index host = 0, part = 0;
  bool welded = false;  ///< its ends are one vertex
};

/// A strip around both loops as steps from the first node on.
struct Strip {
  std::vector<Node> nodes;
  std::vector<Step> steps;
  double cost = 0.0;
  std::vector<std::size_t>
      blocked;  ///< nodes at gaps that cannot be closed; then there is no strip
};

/// The gaps between nodes on two loops that run the same way.
class Gaps {
 public:
  /// Keeps references.
  Gaps(const RimLoop& host, const RimLoop& part) : host_(host), part_(part) {}
  const RimLoop& host() const { return host_; }
  const RimLoop& part() const { return part_; }

  /// The cheapest strip through `nodes`, which follow each other around both loops; one at least.
  Strip solve(std::vector<Node> nodes) const;

  /// The cheapest strip through `node` and the rung half way around both loops from there, in which
  /// no vertex holds a whole loop.
  Strip solve_with_second_rung(const Node& node) const;

  /// As in Zip. `strip` has nothing blocked.
  std::vector<Triangle> triangles(const Strip& strip) const;

 private:
  Gap gap_after(const std::vector<Node>& nodes, std::size_t k) const;
  void forbid_repeated_edges(Gap& gap, const Node& start, const Node& end) const;

  const RimLoop& host_;
  const RimLoop& part_;
};

}  // namespace lapwing::zipping
