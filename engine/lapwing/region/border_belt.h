#pragma once

#include <span>
#include <string>
#include <variant>
#include <vector>

#include "lapwing/region/region_spec.h"

namespace lapwing {

/// A belt along the border of the ROI. In each component, its width is `fraction` (0 to 1) of the
/// component's radius.
struct BoundaryAnchors {
  double fraction = 0.1;
  std::string where = "belt";  ///< as in RegionSpec; ignored by ==

  bool operator==(const BoundaryAnchors& other) const { return fraction == other.fraction; }
};

using BeltSpec = std::variant<BoundaryAnchors, RegionSpec>;

/// Returns whether some edge of `v` has only one triangle.
bool on_mesh_boundary(Index v, const Topology& topology);

struct BorderBelt {
  VertexSet vertices;
  /// One vertex of each hole whose rim is in the belt because nothing else would fix the hole's
  /// component.
  std::vector<Index> held_holes;
};

/// Returns the vertices of the ROI that are near its border and not in `handles`. A vertex is near
/// if its geodesic distance to the border, measured inside the ROI, is at most `fraction` times the
/// largest such distance in its component. `handles` contains the vertices of each handle and of
/// each target.
///
/// The border of a component consists of its vertices with neighbours outside the ROI. If there are
/// none, the component is a whole component of the mesh, and its border consists of its rims, the
/// connected components of its boundary. Rims less than half as large as the largest one surround
/// holes, which move with the surface. If the largest rim is small compared with the surface, as on
/// a statue with holes, all rims surround holes, and handles must fix the component. If the
/// component has fewer than two handles, its largest rims are its border nevertheless. A closed
/// component has no border.
///
/// Throws InputError, naming `where`, if the fraction is outside [0, 1].
BorderBelt resolve_border_belt(const BoundaryAnchors& belt, const VertexSet& roi,
                               std::span<const VertexSet> handles, const Mesh& mesh);

}  // namespace lapwing
