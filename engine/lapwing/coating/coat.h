#pragma once

#include <array>
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

/// Put two sources on one patch, (1 - w) of the first and w of the second (paper, section 5.3): all
/// of it but the meshes. {"op": "mix"} in recipes.
struct MixRequest {
  RegionSpec target_patch;
  std::array<CoatSource, 2> sources;
  MixWeight weight;
  Taken taken = Taken::coating;
  std::vector<MovedHandle> handles;  ///< in the patch, moved in the same solve
  /// With Taken::shape `smooth_target` is what the target's frames are free of; 0: of what the
  /// sources' are, as large as that is on the target.
  CoatParameters parameters;
  std::string where = "mix";  ///< as in RegionSpec; no part of the value
};

/// The same with two sources; either may be `target`.
Coated mix(const Mesh& target, const Mesh& first, const Mesh& second, const MixRequest& request);

}  // namespace lapwing
