#pragma once

#include <span>
#include <string>
#include <vector>

#include "lapwing/mesh/surface_point.h"
#include "lapwing/parameterize/domain_map.h"
#include "lapwing/transplant/collar.h"

namespace lapwing {

/// A collar cut open along a path from its seam to its inner loop, and laid over the unit square
/// (paper section 6): the seam at v = 0 from (0, 0) to (1, 0), the inner loop at v = 1, the cut at
/// u = 0 and, coming from the other side, at u = 1.
struct LaidCollar {
  Patch patch;                  ///< vertices on the cut are there twice; see `vertices`
  std::vector<Index> vertices;  ///< own number, but for midpoints -> vertex of the mesh
  std::vector<Index> cut;       ///< the path, vertices of the mesh, from the seam on
  DomainMap map;                ///< per own number
};

/// The vertex of `seam` from which the shortest path leads across `collar`; kNoIndex when none
/// does. `allowed`, when not empty, has one entry per vertex of the mesh, 0 for those not to begin
/// at.
Index best_cut(const Collar& collar, std::span<const Eigen::Vector3d> positions,
               std::span<const char> allowed = {});

/// The vertices of the seam with a neighbour off it: a path may lead across from there.
std::vector<Index> cut_starts(const Collar& collar);

/// Cuts `collar` along the shortest path from `start`, a vertex of its seam from which one leads
/// inside, and lays it by mean value coordinates. Two collars with the same seam, cut from the same
/// vertex, have their cuts aligned. Throws InputError, naming `where`, when no path leads across.
LaidCollar lay_collar(const Collar& collar, std::span<const Eigen::Vector3d> positions, Index start,
                      const std::string& where);

/// Where each vertex of `upper` lies on `lower`: per vertex of the mesh of `upper`, of which there
/// are `vertex_count`, a point on the mesh of `lower`; nowhere off the collar.
std::vector<SurfacePoint> lay_on(const LaidCollar& upper, const LaidCollar& lower,
                                 std::size_t vertex_count);

}  // namespace lapwing
