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
  /// A positive length; features smaller than this belong to the coating.
  double detail_size = 0.0;
  LaplacianWeights weights = LaplacianWeights::cotangent;
  std::string where = "peel";  ///< as in RegionSpec; ignored by ==
  bool operator==(const PeelRequest& other) const {
    return region == other.region && detail_size == other.detail_size && weights == other.weights;
  }
};

/// The result of `peel`.
struct Peeled {
  Mesh mesh;  ///< the given mesh with a smooth region
  /// Per vertex, the vector from the smooth to the given position; 0 for vertices that do not move.
  std::vector<Eigen::Vector3d> displacement;
  /// The vertices that may move: vertices of the region that have no neighbour outside it and are
  /// not on the mesh's boundary.
  VertexSet moved;
  double mean_coating = 0.0;  ///< root mean square length of the displacement over `moved`
  double largest_coating = 0.0;
  std::vector<std::string> warnings;  ///< messages to the user
};

/// Smooths a region of `mesh` (Fairing) and returns the removed detail. Throws InputError if the
/// region does not fit the mesh or is not finite (the message names `region.where`), or unless the
/// detail size is positive (it names `request.where`). Throws Cancelled.
Peeled peel(const Mesh& mesh, const PeelRequest& request, const Progress& progress = {});

/// The form in which a mesh stores its coating as vertex properties.
enum class CarriedCoating {
  displacement,  ///< coating_x, coating_y, coating_z: from the smooth surface to the mesh
  height,        ///< coating_height: the component along the normals of the smooth surface
  laplacians,    ///< coating_x, coating_y, coating_z: Laplacians of the displacement (xi)
};

/// Returns the smooth mesh of `peeled`, the result of `peel` for `mesh` and `request`, with the
/// coating as vertex properties. They replace properties of the same names. Discards
/// `Mesh::source`, because that file lacks these properties.
Mesh with_coating(const Mesh& mesh, const PeelRequest& request, const Peeled& peeled,
                  CarriedCoating carried);

}  // namespace lapwing
