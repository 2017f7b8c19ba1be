#pragma once

#include <optional>
#include <string>
#include <vector>

#include "lapwing/base/progress.h"
#include "lapwing/region/region_spec.h"
#include "lapwing/remesh/isotropic.h"
#include "lapwing/remesh/quality.h"

namespace lapwing {

/// Give a region triangles of one size: all of it but the mesh.
struct RemeshRequest {
  RegionSpec region;
  std::optional<double> length;  ///< wanted edge length, above 0; none: `scale` says it
  double scale = 1.0;            ///< wanted edge length over the region's mean one, above 0
  RemeshOptions options;
  std::string where = "remesh";  ///< as in RegionSpec; no part of the value
  bool operator==(const RemeshRequest& other) const {
    return region == other.region && length == other.length && scale == other.scale &&
           options == other.options;
  }
};

/// What `remesh` makes of a mesh.
struct Remeshed {
  Mesh mesh;
  std::vector<Index> kept;            ///< as in RemeshResult
  VertexSet region;                   ///< likewise
  RegionQuality before;               ///< of the request's region
  RegionQuality after;                ///< of `region`
  std::vector<std::string> warnings;  ///< for a person
};

/// `remesh_isotropic` with the same length everywhere. Throws InputError, naming the region's
/// `where`, for a region that does not fit the mesh; naming `where`, for a scale on faces whose
/// edges have no length; and what `remesh_isotropic` throws.
Remeshed remesh(const Mesh& mesh, const RemeshRequest& request, const Progress& progress = {});

}  // namespace lapwing
