#pragma once

#include <span>
#include <string>
#include <vector>

#include "lapwing/mesh/closest_point.h"
#include "lapwing/mesh/topology.h"
#include "lapwing/parameterize/domain_map.h"
#include "lapwing/region/boundary_loops.h"

namespace lapwing {

/// An annulus of a surface between one of its boundary loops, the seam, and an inner loop at some
/// distance. Vertex indices are those of the mesh.
struct Collar {
  std::vector<Triangle> triangles;
  BoundaryLoop seam;   ///< in order, with the collar on its left
  BoundaryLoop inner;  ///< in order, with the collar on its left
};

/// Returns the collar of `piece` along `seam`, one of its boundary loops. It consists of the
/// triangles with a corner nearer than `width`, and of those that these separate from the largest
/// remaining component, so that the inner boundary is one loop. `distances` are distances from the
/// seam, one per vertex of the mesh. The result is empty if all or none of the piece is within the
/// width. Throws InputError, naming `where`, if another boundary or a topological handle is within
/// the width, so that the collar is not an annulus. Near-linear in the piece.
Collar make_collar(std::span<const Triangle> piece, const BoundaryLoop& seam,
                   std::span<const double> distances, double width, const std::string& where);

/// A collar cut open along a path from its seam to its inner loop and mapped to the unit square
/// (paper section 6). The seam is mapped to v = 0 from (0, 0) to (1, 0), the inner loop to v = 1,
/// and the two sides of the cut to u = 0 and u = 1.
struct MappedCollar {
  Patch patch;                  ///< contains the vertices on the cut twice; see `vertices`
  std::vector<Index> vertices;  ///< local index, except of midpoints -> vertex of the mesh
  std::vector<Index> cut;       ///< the path as vertices of the mesh, starting at the seam
  DomainMap map;                ///< by local index
};

/// Returns the seam vertex at which the shortest path across `collar` starts, or kNoIndex if there
/// is none. `allowed` is empty or has one entry per vertex of the mesh; paths must not start at
/// vertices whose entry is 0.
Index best_cut(const Collar& collar, std::span<const Eigen::Vector3d> positions,
               std::span<const char> allowed = {});

/// Returns the seam vertices that have a neighbour not on the seam. A path across the collar may
/// start there.
std::vector<Index> cut_starts(const Collar& collar);

/// Cuts `collar` along the shortest path from `start`, a vertex of its seam, and maps it by mean
/// value coordinates. If two collars have the same seam and `start`, the map between them aligns
/// their cuts. Throws InputError, naming `where`, if there is no path from `start`.
MappedCollar map_collar(const Collar& collar, std::span<const Eigen::Vector3d> positions,
                        Index start, const std::string& where);

/// Maps the vertices of `upper` to `lower` through the square. Returns, for each of the
/// `vertex_count` vertices of `upper`'s mesh, a point on `lower`'s mesh, or nowhere().
std::vector<SurfacePoint> lay_on(const MappedCollar& upper, const MappedCollar& lower,
                                 std::size_t vertex_count);

}  // namespace lapwing
