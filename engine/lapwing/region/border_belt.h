#pragma once

#include <string>
#include <variant>

#include "lapwing/region/region_spec.h"

namespace lapwing {

/// A belt measured in from the ROI's border: each component of the ROI by itself, `fraction` (0 to
/// 1) of its radius wide.
struct BorderBelt {
  double fraction = 0.1;
  std::string where = "belt";  ///< as in RegionSpec; no part of the value

  bool operator==(const BorderBelt& other) const { return fraction == other.fraction; }
};

using BeltSpec = std::variant<BorderBelt, RegionSpec>;

/// Whether some edge of `v` has a triangle on one side only.
bool on_mesh_boundary(Index v, const Topology& topology);

/// The border of the ROI's components: the vertices with a ring neighbour outside the ROI; where a
/// component touches none, its vertices on the mesh's boundary. Empty on a closed component.
VertexSet roi_border(const VertexSet& roi, const Topology& topology);

/// The vertices of the ROI whose geodesic distance to the border is at most `fraction` of the
/// largest such distance in their component. Paths stay in the ROI. Throws InputError, naming
/// `where`, when the fraction lies outside 0 to 1.
VertexSet resolve_border_belt(const BorderBelt& belt, const VertexSet& roi, const Mesh& mesh);

}  // namespace lapwing
