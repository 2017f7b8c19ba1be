#pragma once

#include <vector>

#include "lapwing/mesh/mesh.h"

namespace lapwing {

/// The faces, ascending, whose vertices are those of an earlier face in any order. Faces without
/// corners are left out. Near-linear.
std::vector<Index> find_repeated_faces(const Mesh& mesh);

}  // namespace lapwing
