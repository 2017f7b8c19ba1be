#pragma once

#include <optional>
#include <string>
#include <vector>

#include "lapwing/base/progress.h"
#include "lapwing/region/region_spec.h"
#include "lapwing/remesh/isotropic.h"
#include "lapwing/remesh/quality.h"

namespace lapwing {

/// Input of `remesh` besides the mesh.
struct RemeshRequest {
  RegionSpec region;
  std::optional<double> length;  ///< wanted edge length, above 0; if empty, `scale` sets it
  double scale = 1.0;            ///< wanted edge length over the region's mean one, above 0
  RemeshOptions options;
  std::string where = "remesh";  ///< as in RegionSpec; ignored by ==
  bool operator==(const RemeshRequest& other) const {
    return region == other.region && length == other.length && scale == other.scale &&
           options == other.options;
  }
};

/// Result of `remesh`.
struct Remeshed {
  Mesh mesh;
  std::vector<Index> kept;            ///< as in RemeshResult
  VertexSet region;                   ///< as in RemeshResult
  RegionQuality before;               ///< quality of the request's region
  RegionQuality after;                ///< quality of `region`
  std::vector<std::string> warnings;  ///< for the user
};

/// `remesh_isotropic` with the same length everywhere. Throws InputError, naming the region's
/// `where`, if the region does not fit the mesh. Throws InputError, naming `where`, if there is
/// only a scale and the region's edges have no length. Also throws what `remesh_isotropic` throws.
Remeshed remesh(const Mesh& mesh, const RemeshRequest& request, const Progress& progress = {});

}  // namespace lapwing
