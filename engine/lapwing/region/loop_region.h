#pragma once

#include <string>

#include "lapwing/region/region_spec.h"

namespace lapwing {

/// Resolves a loop whose vertices exist. The loop cuts the surface along the edges that it passes
/// an odd number of times; passing there and back is no cut. The region consists of the triangles
/// reachable from `inside` across uncut edges. The loop does not separate the mesh if a cut edge
/// has the region on both sides. Throws InputError as `resolve` does.
VertexSet resolve_loop(const LoopRegion& region, const std::string& where, const Mesh& mesh);

}  // namespace lapwing
