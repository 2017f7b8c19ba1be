#pragma once

#include <vector>

#include "lapwing/mesh/topology.h"
#include "lapwing/region/vertex_set.h"

namespace lapwing {

/// Returns the connected components of `region` along ring edges, ordered by smallest vertex.
/// Vertices with an empty ring belong to none, because only their handle moves them.
std::vector<VertexSet> region_components(const VertexSet& region, const Topology& topology);

}  // namespace lapwing
