#pragma once

#include <vector>

#include "lapwing/solve/dissection/mesh_dissection.h"
#include "lapwing/solve/ordering.h"

namespace lapwing {

/// These functions choose the elimination order for the matrices of a mesh. `pattern` is the
/// pattern of M'M, and `coupling` is its graph of rows.

/// Returns an order that is found fast, because a preview waits for it. It is found by minimum
/// degree. Above kMinimumDegreeLimit unknowns it is found by nested dissection, and its
/// `operations` are 0.
EliminationOrder quick_order(const BlockPattern& pattern, const CouplingGraph& coupling);

/// Returns the order of nested dissection if the search for it costs less time than it saves in one
/// factorization in 3 x 3 blocks, compared with `quick`. Otherwise returns an empty list.
std::vector<int> thorough_order(const EliminationOrder& quick, const CouplingGraph& coupling);

}  // namespace lapwing
