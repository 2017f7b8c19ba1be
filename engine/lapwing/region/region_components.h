#pragma once

#include <vector>

#include "lapwing/mesh/topology.h"
#include "lapwing/region/vertex_set.h"

namespace lapwing {

/// The pieces of `region` that ring edges between its own vertices connect, ordered by smallest
/// vertex. Vertices with an empty ring belong to no piece: nothing moves them but their handle.
std::vector<VertexSet> region_components(const VertexSet& region, const Topology& topology);

}  // namespace lapwing
