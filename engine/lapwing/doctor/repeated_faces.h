#pragma once

#include <vector>

#include "lapwing/mesh/mesh.h"

namespace lapwing {

/// Returns the faces, ascending, that have the same vertices as an earlier face, in any order.
/// Skips faces without corners. Near-linear.
std::vector<Index> find_repeated_faces(const Mesh& mesh);

}  // namespace lapwing
