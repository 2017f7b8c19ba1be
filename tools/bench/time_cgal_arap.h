#pragma once

#include "lapwing/mesh/topology.h"
#include "lapwing/region/edit_region.h"
#include "measure.h"

namespace lapwing::bench {

/// CGAL's preparation (weights, assembly, factorization with Eigen) of an as-rigid-as-possible
/// deformation of the same region, held at belt and handles. The mesh must be a manifold.
Samples time_cgal_arap(const Mesh& mesh, const Topology& topology, const EditRegion& region,
                       int repeats);

}  // namespace lapwing::bench
