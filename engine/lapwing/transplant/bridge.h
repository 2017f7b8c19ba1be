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
  /// Pairs of loop positions that an edge inside the mesh joins. The strip must not contain this
  /// edge again.
  std::vector<std::array<Index, 2>> chords = {};
};

/// Returns the boundary `loop` of a mesh with `across` and `chords`. Linear in the mesh.
BridgeLoop bridge_loop(std::span<const Triangle> triangles,
                       std::span<const Eigen::Vector3d> positions, const BoundaryLoop& loop);

/// The strip that closes the gap between two boundary loops.
struct Bridge {
  /// Pairs (position in the host's loop, position in the part's loop) of vertices to merge, because
  /// triangles between them would be degenerate. Ascending.
  std::vector<std::array<Index, 2>> welded;
  /// Corners below host.size() are positions in the host's loop; the others, minus host.size(), are
  /// positions in the part's loop. A welded vertex has its position in the host's loop. The
  /// orientation is that of host and part: each loop edge, reversed, is the first edge of one
  /// triangle, whose apex is on the other loop. An edge has no triangle if its ends are welded to
  /// the ends of an edge of the other loop.
  std::vector<Triangle> triangles;
};

/// Bridges two loops by a strip of triangles, each with an edge on one loop and its apex on the
/// other. The numbers of vertices may differ. The strip costs at most as much as the cheapest one
/// through the two closest vertices (dynamic programming after Fuchs, Kedem and Uselton 1977;
/// bridge_path.h). Upright triangles that bend little, also against the `across` triangles, are
/// cheap; folds are expensive. Pairs of vertices nearer than `weld` times their shortest loop edge
/// are merged, unless this changes the order in a loop or repeats an edge. If host and part are
/// manifolds, the result is a manifold. Unless several strips are equally good, the result depends
/// neither on the start of the loops nor on a common similarity transform. Throws InputError,
/// naming `where`, if a loop has fewer than 3 vertices, zero length, a position that is not finite,
/// or a size above 1e50. Near-linear.
Bridge bridge_loops(const BridgeLoop& host, const BridgeLoop& part, const std::string& where,
                    double weld = 0.05);

}  // namespace lapwing
