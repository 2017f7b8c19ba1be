#pragma once

#include <string>
#include <vector>

#include "lapwing/base/progress.h"
#include "lapwing/mesh/mesh.h"
#include "lapwing/parameterize/domain_map.h"
#include "lapwing/parameterize/stretch.h"
#include "lapwing/region/region_spec.h"

namespace lapwing {

/// A request to map a region to the plane, without the mesh.
struct ParameterizeRequest {
  RegionSpec region;  ///< a disk
  Domain domain = Domain::disk;
  /// As BoundaryPins, but in vertices of the mesh; empty: `default_pins`.
  std::vector<Index> pins;
  std::string where = "parameterize";  ///< as in RegionSpec; ignored by ==
  bool operator==(const ParameterizeRequest& other) const {
    return region == other.region && domain == other.domain && pins == other.pins;
  }
};

/// The result of `parameterize`.
struct Parameterized {
  /// The given mesh with the map as texture coordinates (see `with_uvs`). They fill the unit
  /// square: those of a disk are (point + (1, 1)) / 2.
  Mesh mesh;
  Patch patch;
  std::vector<Eigen::Vector3d> positions;  ///< per own number of the patch
  DomainMap map;
  BoundaryPins pins;           ///< in own numbers
  std::vector<Index> flipped;  ///< triangles of the patch
  MapDistortion distortion;
  std::vector<std::string> warnings;  ///< messages to the user
};

/// Maps the region of `mesh` to the domain by mean value coordinates. Throws InputError, naming the
/// region's `where`, if the region does not fit the mesh or is not a disk, and naming `where` if a
/// pin is not in the patch; what `mean_value_map` throws about pins and positions; and Cancelled.
Parameterized parameterize(const Mesh& mesh, const ParameterizeRequest& request,
                           const Progress& progress = {});

}  // namespace lapwing
