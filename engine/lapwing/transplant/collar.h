#pragma once

#include <span>
#include <string>
#include <vector>

#include "lapwing/mesh/topology.h"
#include "lapwing/region/boundary_loops.h"

namespace lapwing {

/// The surface next to one of its boundary loops: an annulus between that loop, the seam, and an
/// inner one that was offset from it. Vertices are those of the mesh.
struct Collar {
  std::vector<Triangle> triangles;
  BoundaryLoop seam;   ///< in order, the collar on its left
  BoundaryLoop inner;  ///< likewise
};

/// The collar of `piece` along `seam`, one of its boundary loops: every triangle with a corner
/// nearer than `width`, and what these enclose beside the largest piece left, so that the offset
/// has one loop whatever stands on the surface there. `distances` from the seam, one per vertex of
/// the mesh. Empty (no triangles) when nothing of the piece is left beyond the width, or within it.
/// Throws InputError, naming `where`, when what is left is no annulus: another boundary of the mesh
/// lies within the width, or a handle does. Near-linear in the piece.
Collar make_collar(std::span<const Triangle> piece, const BoundaryLoop& seam,
                   std::span<const double> distances, double width, const std::string& where);

}  // namespace lapwing
