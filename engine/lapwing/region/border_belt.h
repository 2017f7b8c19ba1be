#pragma once

#include <string>
#include <variant>

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

/// Returns the vertices of the ROI that have a ring neighbour outside it. A component without any
/// contributes its vertices on the mesh boundary, so a closed one contributes none.
VertexSet roi_border(const VertexSet& roi, const Topology& topology);

/// Returns the vertices of the ROI whose geodesic distance to the border is at most `fraction` of
/// the largest such distance in their component. Paths stay in the ROI. Throws InputError, naming
/// `where`, if the fraction is not from 0 to 1.
VertexSet resolve_border_belt(const BoundaryAnchors& belt, const VertexSet& roi, const Mesh& mesh);

}  // namespace lapwing
