#pragma once

#include "lapwing/solve/block_cholesky/elimination_graph.h"
#include "lapwing/solve/block_cholesky/symbolic.h"

namespace lapwing::cholesky {

/// Second half of the symbolic factorization. Expects fronts with first_block, pivot_blocks,
/// update_blocks, parent and children, and the order. Fills rows, positions, pieces, entries and
/// the fronts' sizes and offsets into those.
void find_structure(const BlockPattern& pattern, const EliminationGraph& graph, Symbolic& symbolic);

}  // namespace lapwing::cholesky
