#pragma once

#include <string>
#include <vector>

#include "lapwing/coating/prepared_coat.h"

namespace lapwing {

/// What `coat` or `mix` makes of a mesh.
struct Coated {
  Mesh mesh;  ///< the target; with a finer patch where the request's remeshing makes one
  CoatReport report;
  std::vector<std::string> warnings;  ///< for a person, in the order of the work
};

/// `target` with the detail of a patch of `source` on a patch of its own (paper, section 5). The
/// processor computes it. To change amplitude or detail size again and again keep a PreparedCoat.
/// Throws InputError, naming the region or pair, for what does not fit the meshes, and SolverError.
Coated coat(const Mesh& target, const Mesh& source, const CoatRequest& request);

/// The same with two sources; either may be `target`.
Coated mix(const Mesh& target, const Mesh& first, const Mesh& second, const MixRequest& request);

}  // namespace lapwing
