#pragma once

#include <cstddef>

#include "lapwing/mesh/mesh.h"
#include "lapwing/region/vertex_set.h"

namespace lapwing {

/// How the faces whose corners are all in a region are shaped.
struct RegionQuality {
  std::size_t vertices = 0;  ///< that these faces use
  std::size_t faces = 0;
  double mean_edge = 0.0;               ///< 0 without faces
  double smallest_angle_degrees = 0.0;  ///< of their corners; 0 without faces
};
RegionQuality region_quality(const Mesh& mesh, const VertexSet& region);

}  // namespace lapwing
