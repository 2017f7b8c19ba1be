#pragma once

#include <span>
#include <string>
#include <vector>

#include "lapwing/region/border_belt.h"

namespace lapwing {

/// What one edit concerns. Vertices of the ROI in neither belt nor handle are free; vertices
/// outside the ROI do not move.
struct EditRegion {
  VertexSet roi;
  VertexSet belt;                  ///< in the ROI; stays where it is
  std::vector<VertexSet> handles;  ///< in the ROI, disjoint, not empty, none shared with the belt
};

/// Binds what a person chose to a mesh. A belt by fraction leaves the handles out; every other
/// overlap is an error. Throws InputError, naming place and vertices: whatever `resolve` throws, an
/// empty ROI or handle, a handle or belt outside the ROI, a handle that overlaps the belt or
/// another handle, a vertex of the ROI or of its rings that is not finite, and what `check_anchors`
/// throws.
EditRegion resolve_edit_region(const RegionSpec& roi, const BeltSpec& belt,
                               std::span<const RegionSpec> handles, const Mesh& mesh);

/// Throws InputError unless every component of the ROI is held: its anchors are its handle and belt
/// vertices and its neighbours outside the ROI, and three of them must not lie on one line, or the
/// component could turn freely. Names the component by size and smallest vertex, and `where`.
/// Vertices with an empty ring need no anchor.
void check_anchors(const EditRegion& region, std::span<const Eigen::Vector3d> positions,
                   const Topology& topology, const std::string& where);

}  // namespace lapwing
