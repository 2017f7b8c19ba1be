#pragma once

#include <span>
#include <vector>

#include "lapwing/mesh/mesh.h"

namespace lapwing::bridging {

/// A section of a boundary loop: its vertices and, per edge, the unit normal of the adjacent
/// triangle of the mesh, zero if unknown.
struct Chain {
  Positions points;
  std::vector<Eigen::Vector3d> normals;
  std::size_t edge_count() const { return normals.size(); }
};

/// A step along one of the two chains. A host step from i to i + 1, with the part at j, adds the
/// triangle (i + 1, i, j). A step along the part from j to j + 1, with the host at i,
/// adds the triangle (j, j + 1, i).
enum class Step : unsigned char { host, part };

/// The gap between two chains with the same direction. The host's surface is on the left of its
/// chain, the part's surface on the right. A rung (i, j) is an edge from host vertex i to part
/// vertex j. The first and the last rung are given.
struct Gap {
  Chain host, part;
  bool starts_welded = false;  ///< the first vertices are merged: no triangle contains both
  bool ends_welded = false;    ///< the last vertices are merged
  bool closed = false;         ///< the last rung equals the first
  /// Forbidden rungs, which would repeat an edge: from each host vertex to the first or last part
  /// vertex, and vice versa. One entry per vertex, or empty.
  std::vector<char> no_rung_to_part_start, no_rung_to_part_end;
  std::vector<char> no_rung_to_host_start, no_rung_to_host_end;
};

/// The cheapest triangulation of a gap.
struct BridgePath {
  std::vector<Step> steps;  ///< empty if there is none
  double cost = 0.0;
};

/// Returns the shortest path from the first to the last rung in the grid of all rungs (Fuchs, Kedem
/// and Uselton 1977). A triangle costs e (a^2 + b^2) / (2 h), where e is its edge on a chain, a and
/// b are its rungs and h is its height over e. Upright triangles have the lowest cost, and the
/// total cost hardly depends on the vertex counts. Bending at e, and at the rung shared with the
/// previous triangle, increases the cost. O(n m) for up to about 10^5 rungs. Near-linear for larger
/// grids: a path through every fourth vertex is found first, and only rungs near it are searched.
BridgePath shortest_bridge(const Gap& gap);

}  // namespace lapwing::bridging
