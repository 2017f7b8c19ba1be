#pragma once

#include <cstddef>

#include "lapwing/mesh/mesh.h"
#include "lapwing/region/vertex_set.h"

namespace lapwing {

/// Shape statistics of the faces whose corners are all in a region.
struct RegionQuality {
  std::size_t vertices = 0;  ///< vertices of these faces
  std::size_t faces = 0;
  double mean_edge = 0.0;               ///< 0 without faces
  double smallest_angle_degrees = 0.0;  ///< smallest corner angle; 0 without faces
};
RegionQuality region_quality(const Mesh& mesh, const VertexSet& region);

}  // namespace lapwing
