#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "lapwing/base/cancellation.h"
#include "lapwing/mesh/mesh.h"
#include "lapwing/region/region_spec.h"
#include "lapwing/region/vertex_set.h"
#include "lapwing/remesh/isotropic.h"

namespace lapwing {

/// Shape statistics of the faces whose corners are all in a region.
struct RegionQuality {
  std::size_t vertices = 0;  ///< vertices of these faces
  std::size_t faces = 0;
  double mean_edge = 0.0;               ///< 0 without faces
  double smallest_angle_degrees = 0.0;  ///< smallest corner angle; 0 without faces
};
RegionQuality region_quality(const Mesh& mesh, const VertexSet& region);

/// Input of `remesh` besides the mesh.
struct RemeshRequest {
  RegionSpec region = {};
  std::optional<double> length = {};  ///< target edge length, positive; if empty: by `scale`
  double scale = 1.0;                 ///< target / mean edge length of the region, positive
  RemeshOptions options = {};
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
