#pragma once

#include <vector>

#include "lapwing/solve/block_matrix.h"

namespace lapwing {

/// Returns an approximate minimum degree (AMD) order of a graph, new to old. Sets `operations`, if
/// not null, to MinimumDegreeOrder::operations. Cannot be interrupted. Throws SolverError if the
/// graph has too many edges for 31-bit indices.
std::vector<int> minimum_degree(const BlockGraph& graph, double* operations = nullptr);

}  // namespace lapwing
