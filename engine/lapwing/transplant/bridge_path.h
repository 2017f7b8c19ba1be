#pragma once

#include <span>
#include <vector>

#include "lapwing/mesh/mesh.h"

namespace lapwing::bridging {

/// A piece of a boundary loop: its vertices and, per edge, the unit normal of the surface behind
/// it, zero if unknown.
struct Chain {
  Positions points;
  std::vector<Eigen::Vector3d> normals;
  std::size_t edge_count() const { return normals.size(); }
};

/// A step along one of the two chains. A host step from i to i + 1, with the part at j, adds the
/// triangle (i + 1, i, j). A part step from j to j + 1, with the host at i, adds (j, j + 1, i).
enum class Step : unsigned char { host, part };

/// The gap between two chains that run the same way, the host's with its surface on its left, the
/// part's on its right. A rung (i, j) joins host vertex i to part vertex j. The rungs between the
/// first vertices and between the last ones are fixed.
struct Gap {
  Chain host, part;
  bool starts_welded = false;  ///< the first vertices are one: no triangle contains both
  bool ends_welded = false;    ///< likewise the last vertices
  bool closed = false;         ///< the last rung is the first again
  /// Rungs that would repeat an edge: (i, first of the part), (i, last), (first of the host, j),
  /// (last, j). One entry per vertex, or empty.
  std::vector<char> no_rung_to_part_start, no_rung_to_part_end;
  std::vector<char> no_rung_to_host_start, no_rung_to_host_end;
};

/// The cheapest way across a gap.
struct BridgePath {
  std::vector<Step> steps;  ///< empty if there is no way
  double cost = 0.0;
};

/// Returns the shortest path from the first rung to the last in the grid of all rungs (Fuchs, Kedem
/// and Uselton 1977). A triangle costs e (a^2 + b^2) / (2 h), with e its side on a chain, a and b
/// its rungs and h its height over e. Upright triangles cost least, and the cost of the whole gap
/// hardly depends on the vertex counts. Bending at e, and at the rung shared with the triangle
/// before, adds a share of this. O(n m) for up to about 10^5 rungs. Larger grids take near-linear
/// time: a path through every fourth vertex is found first, and only rungs near it are searched.
BridgePath shortest_bridge(const Gap& gap);

}  // namespace lapwing::bridging
