#pragma once

#include <string>
#include <vector>

#include "lapwing/base/cancellation.h"
#include "lapwing/laplacian/weights.h"
#include "lapwing/mesh/mesh.h"
#include "lapwing/region/region_spec.h"
#include "lapwing/region/vertex_set.h"

namespace lapwing {

/// A request to remove the fine detail of a region, without the mesh.
struct PeelRequest {
  RegionSpec region = {};
  double detail_size = 0.0;  ///< a length above 0: features smaller than this are coating
  LaplacianWeights weights = LaplacianWeights::cotangent;
  std::string where = "peel";  ///< as in RegionSpec; ignored by ==
  bool operator==(const PeelRequest& other) const {
    return region == other.region && detail_size == other.detail_size && weights == other.weights;
  }
};

/// The result of `peel`.
struct Peeled {
  Mesh mesh;  ///< the given mesh with smooth positions
  /// Per vertex, from the smooth surface to the given one; 0 for a vertex that does not move.
  std::vector<Eigen::Vector3d> displacement;
  /// The vertices that may move: those of the region that have no neighbour outside it and are not
  /// on the mesh's boundary.
  VertexSet moved;
  double mean_coating = 0.0;  ///< root mean square length of the displacement over `moved`
  double largest_coating = 0.0;
  std::vector<std::string> warnings;  ///< messages to the user
};

/// Smooths a region of `mesh` (Fairing) and returns the removed detail. Throws InputError, naming
/// the region's `where`, if the region does not fit the mesh or is not finite, and naming `where`
/// if the detail size is not above 0; Cancelled.
Peeled peel(const Mesh& mesh, const PeelRequest& request, const Progress& progress = {});

/// The form in which a mesh stores its coating as vertex properties.
enum class CarriedCoating {
  displacement,  ///< coating_x, coating_y, coating_z: from the smooth surface to the mesh
  height,        ///< coating_height: its part along the smooth surface's normals
  laplacians,    ///< coating_x, coating_y, coating_z: its Laplacians, xi of the paper
};

/// Returns the smooth mesh of `peeled`, which `peel` returned for `mesh` and `request`, with the
/// coating in vertex properties. These replace any of the same names. Drops `source`, since the
/// file as it was read has no room for them.
Mesh with_coating(const Mesh& mesh, const PeelRequest& request, const Peeled& peeled,
                  CarriedCoating carried);

}  // namespace lapwing
