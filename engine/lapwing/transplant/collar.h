#pragma once

#include <span>
#include <string>
#include <vector>

#include "lapwing/mesh/closest_point.h"
#include "lapwing/mesh/topology.h"
#include "lapwing/parameterize/domain_map.h"
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

/// A collar cut open along a path from its seam to its inner loop and mapped to the unit square
/// (paper section 6). The seam lies on v = 0 from (0, 0) to (1, 0), the inner loop on v = 1, and
/// the two sides of the cut on u = 0 and u = 1.
struct MappedCollar {
  Patch patch;                  ///< contains the vertices on the cut twice; see `vertices`
  std::vector<Index> vertices;  ///< own number, midpoints excepted -> vertex of the mesh
  std::vector<Index> cut;       ///< the path, vertices of the mesh, from the seam on
  DomainMap map;                ///< per own number
};

/// Returns the vertex of `seam` from which the shortest path leads across `collar`, or kNoIndex if
/// none does. A path must not start at a vertex whose entry in `allowed` is 0. `allowed` has one
/// entry per vertex of the mesh, or is empty.
Index best_cut(const Collar& collar, std::span<const Eigen::Vector3d> positions,
               std::span<const char> allowed = {});

/// Returns the seam's vertices with a neighbour off the seam, from which a path may lead across.
std::vector<Index> cut_starts(const Collar& collar);

/// Cuts `collar` along the shortest path from `start`, a vertex of its seam, and maps it by mean
/// value coordinates. Two collars with the same seam, cut from the same vertex, have their cuts
/// aligned. Throws InputError, naming `where`, if no path leads across from `start`.
MappedCollar map_collar(const Collar& collar, std::span<const Eigen::Vector3d> positions,
                        Index start, const std::string& where);

/// Maps the vertices of `upper` to `lower` through the square. Returns one point on the mesh of
/// `lower` for each of the `vertex_count` vertices of the mesh of `upper`; nowhere off the collar.
std::vector<SurfacePoint> lay_on(const MappedCollar& upper, const MappedCollar& lower,
                                 std::size_t vertex_count);

}  // namespace lapwing
