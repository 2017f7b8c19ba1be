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
  std::optional<double> length = {};  ///< target edge length, positive; if empty, `scale` is used
  double scale = 1.0;                 ///< target length / mean edge length of the region; positive
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

/// Calls `remesh_isotropic` with a constant length. Throws InputError, naming `region.where`, if
/// the region does not fit the mesh; InputError, naming `request.where`, if the length is given by
/// a scale and all edges have length 0; and the errors of `remesh_isotropic`.
Remeshed remesh(const Mesh& mesh, const RemeshRequest& request, const Progress& progress = {});

}  // namespace lapwing
