#pragma once

#include <array>
#include <vector>

#include "lapwing/mesh/surface_point.h"
#include "lapwing/remesh/working_patch.h"

namespace lapwing::remeshing {

/// Where the patch's vertices, corners and triangles lie on the original mesh. The corners of a
/// vertex between two lines form a sector; they share their attributes.
struct AttributeSources {
  std::vector<SurfacePoint> vertices;     ///< per vertex, in mesh vertices; nowhere if removed
  std::vector<Index> sectors_of_corners;  ///< per half-edge: the sector of its origin's corner
  std::vector<SurfacePoint> sectors;      ///< in corners of the mesh
  std::vector<Index> faces;               ///< per triangle: a face of the mesh; kNoIndex if removed
};

AttributeSources find_attribute_sources(const WorkingPatch& patch);

/// Returns the corner with the largest weight.
Index nearest_corner(const SurfacePoint& point);

}  // namespace lapwing::remeshing
