#pragma once

#include <span>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "lapwing/base/cancellation.h"
#include "lapwing/mesh/mesh.h"
#include "lapwing/mesh/topology.h"
#include "lapwing/parameterize/domain_map.h"
#include "lapwing/parameterize/patch.h"
#include "lapwing/region/region_spec.h"

namespace lapwing {

/// The distortion of a planar triangulation relative to its surface. Let G >= g be the largest and
/// smallest factors by which lengths in a triangle change from the plane to the surface (singular
/// values). Its stretch is sqrt((G^2 + g^2) / 2) (Sander et al. 2001), and its shear is G / g. The
/// stretch is divided by that of a similarity with the same total areas. For a similarity, both
/// measures are 1.
struct MapDistortion {
  double stretch = 1.0;          ///< root mean square over the surface
  double largest_stretch = 1.0;  ///< of any triangle
  double shear = 1.0;            ///< mean over the surface
  double largest_shear = 1.0;
};

/// Ignores triangles with zero area in the plane or on the surface.
MapDistortion measure_distortion(std::span<const Triangle> triangles,
                                 std::span<const Eigen::Vector3d> positions,
                                 std::span<const Eigen::Vector2d> points);

/// A request to map a region to the plane, without the mesh.
struct ParameterizeRequest {
  RegionSpec region = {};  ///< the region to map; must be a disk
  Domain domain = Domain::disk;
  /// As BoundaryPins, but vertices of the mesh. If empty, `default_pins` chooses them.
  std::vector<Index> pins = {};
  std::string where = "parameterize";  ///< as in RegionSpec; ignored by ==
  bool operator==(const ParameterizeRequest& other) const {
    return region == other.region && domain == other.domain && pins == other.pins;
  }
};

/// The result of `parameterize`.
struct Parameterized {
  /// The given mesh with the map as texture coordinates (see `with_uvs`) in the unit square. The
  /// texture coordinates of a disk are (point + (1, 1)) / 2.
  Mesh mesh;
  Patch patch;
  std::vector<Eigen::Vector3d> positions;  ///< by local index of the patch
  DomainMap map;
  BoundaryPins pins;           ///< as local indices
  std::vector<Index> flipped;  ///< triangles of the patch
  MapDistortion distortion;
  std::vector<std::string> warnings;  ///< messages to the user
};

/// Maps the region of `mesh` to the domain by mean value coordinates. Throws InputError if the
/// region does not fit the mesh or is not a disk (the message names `region.where`), or if a pin is
/// not in the patch (it names `request.where`). Also throws the errors of `mean_value_map`, and
/// Cancelled.
Parameterized parameterize(const Mesh& mesh, const ParameterizeRequest& request,
                           const Progress& progress = {});

/// Returns `mesh` with `uvs`, one per local index of the patch, as texture coordinates of the
/// polygons whose triangles are all in the patch. The texture coordinates of all other polygons are
/// removed. Polygons with a halved edge are replaced by the patch's triangles, and the midpoints
/// are appended as vertices. All other polygons are unchanged.
Mesh with_uvs(const Mesh& mesh, const Patch& patch, std::span<const Eigen::Vector2d> uvs);

}  // namespace lapwing
