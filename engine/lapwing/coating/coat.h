#pragma once

#include <string>
#include <vector>

#include "lapwing/coating/prepared_coat.h"

namespace lapwing {

/// The result of `coat` or `mix`.
struct Coated {
  Mesh mesh;  ///< the target, with a finer patch if it was remeshed
  CoatReport report;
  std::vector<std::string> warnings;  ///< messages to the user, in the order of the work
};

/// Puts the detail of a patch of `source` on a patch of `target` (paper, section 5). Runs on the
/// CPU. To vary amplitude or detail size, keep a PreparedCoat. Throws InputError, naming the region
/// or pair, if the request does not fit the meshes, and SolverError.
Coated coat(const Mesh& target, const Mesh& source, const CoatRequest& request);

/// The same with two sources; either may be `target`.
Coated mix(const Mesh& target, const Mesh& first, const Mesh& second, const MixRequest& request);

}  // namespace lapwing
