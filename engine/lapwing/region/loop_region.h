#pragma once

#include <string>

#include "lapwing/region/region_spec.h"

namespace lapwing {

/// `resolve` for a loop whose vertices exist. The loop cuts the surface along the edges that it
/// passes an odd number of times (there and back is no cut); the region is what triangles across
/// uncut edges reach from `inside`. It separates when no cut edge has that region on two sides.
VertexSet resolve_loop(const LoopRegion& region, const std::string& where, const Mesh& mesh);

}  // namespace lapwing
