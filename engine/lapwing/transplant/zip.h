#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "lapwing/mesh/topology.h"

namespace lapwing {

/// The strip that closes the gap between two boundary loops.
struct Zip {
  /// Pairs (place in the host's loop, place in the part's) that are one vertex: so close together
  /// that a triangle between them would have no area worth having.
  std::vector<std::array<Index, 2>> welded;
  /// Corners below host.size() are places in the host's loop, the others, less host.size(), in the
  /// part's. Oriented as host and part are: each boundary edge of either loop is the side of one
  /// triangle, run through the other way. Welded part vertices are already the host's; an edge with
  /// both ends welded to both ends of one of the host's needs no triangle.
  std::vector<Triangle> triangles;
};

/// Zips two loops, each given in order with its surface on its left, whose numbers may differ:
/// among all strips that go around both once, the one of smallest cost (dynamic programming after
/// Fuchs, Kedem and Uselton 1977), where cost prefers triangles without long edges, of good shape
/// and that bend little against their neighbours and the `host_across` and `part_across` triangles
/// behind the loop's edges. Pairs nearer than `weld` times the shorter of the loop edges around
/// them become one vertex where that keeps both orders. Loops of 3 vertices or more. Throws
/// InputError, naming `where`, for a loop of fewer or one that is not finite or has no length.
///
/// `host_across[k]` is the third corner of the triangle on the loop's edge k -> k + 1; empty: not
/// considered. O(n m) at worst for loops of n and m vertices, near-linear time and memory in
/// practice (the best partner of each start is near the last one's).
struct ZipLoop {
  std::span<const Eigen::Vector3d> points;
  std::span<const Eigen::Vector3d> across = {};
};
Zip zip_loops(const ZipLoop& host, const ZipLoop& part, const std::string& where,
              double weld = 0.05);

}  // namespace lapwing
