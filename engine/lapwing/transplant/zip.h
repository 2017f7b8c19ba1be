#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "lapwing/mesh/topology.h"
#include "lapwing/region/boundary_loops.h"

namespace lapwing {

/// A boundary loop as zipping sees it, with its surface on its left.
struct ZipLoop {
  Positions points;  ///< in order
  /// The third corner of the triangle on the loop's edge k -> k + 1; empty: not considered.
  Positions across = {};
  /// Places in the loop of vertices that an edge inside the mesh joins, so that no triangle of the
  /// strip may have a side there.
  std::vector<std::array<Index, 2>> chords = {};
};

/// `loop` of a mesh with all that there is to know. Linear in the mesh.
ZipLoop zip_loop(std::span<const Triangle> triangles, std::span<const Eigen::Vector3d> positions,
                 const BoundaryLoop& loop);

/// The strip that closes the gap between two boundary loops.
struct Zip {
  /// Pairs (place in the host's loop, place in the part's) that are one vertex: so close together
  /// that a triangle between them would have no area worth having. Ascending.
  std::vector<std::array<Index, 2>> welded;
  /// Corners below host.size() are places in the host's loop, the others, less host.size(), in the
  /// part's. Oriented as host and part are: each boundary edge of either loop is the first side of
  /// one triangle, run through the other way; the apex is on the other loop. Welded part vertices
  /// are already the host's; an edge with both ends welded to both ends of one of the host's needs
  /// no triangle.
  std::vector<Triangle> triangles;
};

/// Zips two loops whose numbers may differ: among the strips that go around both once, each
/// triangle on one edge of a loop with its apex on the other, the one of smallest cost (dynamic
/// programming after Fuchs, Kedem and Uselton 1977; see zip_path.h) that passes the two closest
/// vertices or does better. Upright triangles that bend little against each other and against the
/// `across` triangles are cheap, folds dear. Pairs nearer than `weld` times the shortest of the
/// loop edges at them become one vertex where that keeps both orders and no edge is there twice.
/// Host, strip and part are then a manifold if host and part are. Where the loops are the same up
/// to a turn of the start, the strip is the same; turning, moving and scaling both does not change
/// it (but where several strips are equally good). Throws InputError, naming `where`, for a loop of
/// fewer than 3 vertices, one that is not finite, larger than 1e50 or has no length. Near-linear.
Zip zip_loops(const ZipLoop& host, const ZipLoop& part, const std::string& where,
              double weld = 0.05);

}  // namespace lapwing
