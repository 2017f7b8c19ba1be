#pragma once

#include <string>
#include <vector>

#include "lapwing/base/progress.h"
#include "lapwing/mesh/mesh.h"
#include "lapwing/parameterize/domain_map.h"
#include "lapwing/parameterize/stretch.h"
#include "lapwing/region/region_spec.h"

namespace lapwing {

/// Lay a region into the plane: all of it but the mesh.
struct ParameterizeRequest {
  RegionSpec region;  ///< a disk
  Domain domain = Domain::disk;
  /// As BoundaryPins, but vertices of the mesh; none: `default_pins`.
  std::vector<Index> pins;
  std::string where = "parameterize";  ///< as in RegionSpec; no part of the value
  bool operator==(const ParameterizeRequest& other) const {
    return region == other.region && domain == other.domain && pins == other.pins;
  }
};

/// What `parameterize` makes of a mesh.
struct Parameterized {
  /// The one given with the patch's places as texture coordinates: `uv_mesh.h` says of which
  /// corners. They fill the unit square: those of a disk are (point + (1, 1)) / 2.
  Mesh mesh;
  Patch patch;
  std::vector<Eigen::Vector3d> positions;  ///< of the patch's own vertices
  DomainMap map;
  BoundaryPins pins;           ///< own numbers
  std::vector<Index> flipped;  ///< triangles of the patch
  MapDistortion distortion;
  std::vector<std::string> warnings;  ///< for a person
};

/// Lays the region of `mesh` into the domain by mean value coordinates. Throws InputError, naming
/// the region's `where`, for a region that does not fit the mesh or is no disk; naming `where`, for
/// a pin that is not in the patch; what `mean_value_map` throws of pins and positions; and
/// Cancelled.
Parameterized parameterize(const Mesh& mesh, const ParameterizeRequest& request,
                           const Progress& progress = {});

}  // namespace lapwing
