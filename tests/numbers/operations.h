#pragma once

#include <functional>
#include <string>
#include <vector>

#include "lapwing/mesh/mesh.h"
#include "numbers/placement.h"

namespace lapwing::test {

/// One operation with a request made for any mesh: a region around its middle, lengths as shares of
/// its size. What it makes of a mesh that is placed somewhere else is what it makes of the plain
/// one, placed there.
struct Operation {
  std::string name;
  /// The new positions, on the plain mesh, and the faces. `plain` is the mesh itself; regions are
  /// chosen on it, so that they are the same wherever it is placed.
  std::function<Mesh(const Mesh& plain, const Placement& placement)> run;
};

/// deform, peel, remesh, parameterize, coat, mix and transplant. Of parameterize the texture
/// coordinates are the positions.
std::vector<Operation> all_operations();

}  // namespace lapwing::test
