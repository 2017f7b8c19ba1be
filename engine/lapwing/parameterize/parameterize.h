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

/// The distortion of a planar triangulation relative to its surface. With G >= g the largest and
/// least factor by which a triangle's lengths grow from the plane to the surface, its stretch is
/// sqrt((G^2 + g^2) / 2) (Sander et al. 2001), and its shear is G / g. Stretch is divided by that
/// of a similarity map with the same total areas. Both are 1 if the map is a similarity.
struct MapDistortion {
  double stretch = 1.0;          ///< root mean square over the surface
  double largest_stretch = 1.0;  ///< of any triangle
  double shear = 1.0;            ///< mean over the surface
  double largest_shear = 1.0;
};

/// Ignores triangles without area in the plane or on the surface.
MapDistortion measure_distortion(std::span<const Triangle> triangles,
                                 std::span<const Eigen::Vector3d> positions,
                                 std::span<const Eigen::Vector2d> points);

/// A request to map a region to the plane, without the mesh.
struct ParameterizeRequest {
  RegionSpec region = {};  ///< the region to map; must be a disk
  Domain domain = Domain::disk;
  /// As BoundaryPins, but in vertices of the mesh; empty: `default_pins`.
  std::vector<Index> pins = {};
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
  std::vector<Eigen::Vector3d> positions;  ///< per local index of the patch
  DomainMap map;
  BoundaryPins pins;           ///< as local indices
  std::vector<Index> flipped;  ///< triangles of the patch
  MapDistortion distortion;
  std::vector<std::string> warnings;  ///< messages to the user
};

/// Maps the region of `mesh` to the domain by mean value coordinates. Throws InputError, naming the
/// region's `where`, if the region does not fit the mesh or is not a disk, and naming `where` if a
/// pin is not in the patch; what `mean_value_map` throws about pins and positions; and Cancelled.
Parameterized parameterize(const Mesh& mesh, const ParameterizeRequest& request,
                           const Progress& progress = {});

/// Returns `mesh` with `uvs`, one per local vertex index of its patch, as texture coordinates on
/// the corners of the polygons that lie wholly in the patch. All other corners lose theirs.
/// Polygons with a halved edge are replaced by the patch's triangles, with the midpoints as new
/// vertices after the others. No other polygon changes its shape.
Mesh with_uvs(const Mesh& mesh, const Patch& patch, std::span<const Eigen::Vector2d> uvs);

}  // namespace lapwing
