#pragma once

#include <vector>

#include "lapwing/solve/dissection/mesh_dissection.h"
#include "lapwing/solve/ordering.h"

namespace lapwing {

/// These functions choose the elimination order for the matrices of a mesh. `pattern` is the
/// pattern of M'M, and `coupling` is the graph of the rows of M.

/// Returns an order that is found quickly, because a preview waits for it. Up to
/// kMinimumDegreeLimit unknowns, it is a minimum degree order. For more unknowns, it is a nested
/// dissection order, and its `operations` are set to 0.
EliminationOrder quick_order(const BlockPattern& pattern, const CouplingGraph& coupling);

/// Returns a nested dissection order if finding it takes less time than it saves, compared with
/// `quick`, in one factorization in 3 x 3 blocks. Otherwise returns an empty list.
std::vector<int> thorough_order(const EliminationOrder& quick, const CouplingGraph& coupling);

}  // namespace lapwing
