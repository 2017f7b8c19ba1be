#pragma once

#include <span>
#include <string>
#include <vector>

#include "lapwing/mesh/topology.h"
#include "lapwing/region/boundary_loops.h"

namespace lapwing {

/// An annulus of the surface between one of its boundary loops, the seam, and an inner loop offset
/// from it. Vertex numbers are those of the mesh.
struct Collar {
  std::vector<Triangle> triangles;
  BoundaryLoop seam;   ///< in order, with the collar on its left
  BoundaryLoop inner;  ///< likewise
};

/// Returns the collar of `piece` along `seam`, one of its boundary loops. It has every triangle
/// with a corner nearer than `width`, and all that these separate from the largest remaining piece,
/// so that the inner boundary is one loop. `distances` are from the seam, one per vertex of the
/// mesh. Returns no triangles if the piece lies wholly within the width or wholly beyond it. Throws
/// InputError, naming `where`, if another boundary of the mesh or a handle lies within the width,
/// so that the collar is not an annulus. Near-linear in the piece.
Collar make_collar(std::span<const Triangle> piece, const BoundaryLoop& seam,
                   std::span<const double> distances, double width, const std::string& where);

}  // namespace lapwing
