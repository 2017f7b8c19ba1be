#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "lapwing/mesh/topology.h"
#include "lapwing/region/boundary_loops.h"

namespace lapwing {

/// A boundary loop with its surface on its left, as input of `bridge_loops`.
struct BridgeLoop {
  Positions points;  ///< in order
  /// Third corner of the triangle on the loop's edge k -> k + 1; ignored if empty.
  Positions across = {};
  /// Places in the loop of vertices joined by an edge inside the mesh, which no triangle of the
  /// strip may repeat.
  std::vector<std::array<Index, 2>> chords = {};
};

/// Returns `loop` of a mesh with its `across` and `chords`. Linear in the mesh.
BridgeLoop bridge_loop(std::span<const Triangle> triangles,
                       std::span<const Eigen::Vector3d> positions, const BoundaryLoop& loop);

/// The strip that closes the gap between two boundary loops.
struct Bridge {
  /// Pairs (place in the host's loop, place in the part's) that become one vertex, because a
  /// triangle between them would be degenerate. Ascending.
  std::vector<std::array<Index, 2>> welded;
  /// Corners below host.size() are places in the host's loop; the others, less host.size(), are
  /// places in the part's. Oriented as host and part: each boundary edge of either loop, reversed,
  /// is the first side of one triangle, whose apex is on the other loop. Welded part vertices have
  /// the host's number. An edge of one loop needs no triangle if both its ends are welded to those
  /// of an edge of the other.
  std::vector<Triangle> triangles;
};

/// Zips two loops, whose vertex counts may differ. In a strip around both loops, each triangle
/// stands on an edge of one loop and has its apex on the other. The result is the cheapest strip
/// through the two closest vertices, or a cheaper one (dynamic programming after Fuchs, Kedem and
/// Uselton 1977; bridge_path.h). Upright triangles that bend little against each other and against
/// the `across` triangles are cheap; folds are expensive. Pairs nearer than `weld` times the
/// shortest loop edge at them become one vertex, if that keeps both orders and repeats no edge. If
/// host and part are manifolds, host, strip and part together are one. Unless several strips are
/// equally good, the strip depends neither on the loops' starts nor on a common rotation,
/// translation or scale. Throws InputError, naming `where`, if a loop has fewer than 3 vertices, is
/// not finite, is larger than 1e50 or has no length. Near-linear.
Bridge bridge_loops(const BridgeLoop& host, const BridgeLoop& part, const std::string& where,
                    double weld = 0.05);

}  // namespace lapwing
