#pragma once

#include <vector>

#include "lapwing/solve/block_matrix.h"

namespace lapwing {

/// An order of a graph by approximate minimum degree (AMD), new to old. `operations`, where asked
/// for, becomes what MinimumDegreeOrder says. Cannot be interrupted. Throws SolverError where
/// its couplings are too many to be numbered by 31 bits.
std::vector<int> minimum_degree(const BlockGraph& graph, double* operations = nullptr);

}  // namespace lapwing
