#pragma once

#include <string>
#include <vector>

#include "lapwing/base/progress.h"
#include "lapwing/laplacian/weights.h"
#include "lapwing/mesh/mesh.h"
#include "lapwing/region/region_spec.h"
#include "lapwing/region/vertex_set.h"

namespace lapwing {

/// Take the fine detail off a region: all of it but the mesh.
struct PeelRequest {
  RegionSpec region;
  double detail_size = 0.0;  ///< a length above 0: features smaller than this are coating
  LaplacianWeights weights = LaplacianWeights::cotangent;
  std::string where = "peel";  ///< as in RegionSpec; no part of the value
  bool operator==(const PeelRequest& other) const {
    return region == other.region && detail_size == other.detail_size && weights == other.weights;
  }
};

/// What `peel` makes of a mesh.
struct Peeled {
  Mesh mesh;  ///< the one given, with other positions
  /// Per vertex, from the smooth surface to the one given; 0 where a vertex does not move.
  std::vector<Eigen::Vector3d> displacement;
  /// The vertices that may move: those of the region that have no neighbour outside it and are not
  /// on the mesh's boundary.
  VertexSet moved;
  double mean_coating = 0.0;  ///< root mean square length of the displacement over `moved`
  double largest_coating = 0.0;
  std::vector<std::string> warnings;  ///< for a person
};

/// `mesh` with its region smooth (Fairing), and what came off. Throws InputError, naming the
/// region's `where`, for a region that does not fit the mesh or that holds a vertex without finite
/// position, and naming `where` for a detail size not above 0; Cancelled.
Peeled peel(const Mesh& mesh, const PeelRequest& request, const Progress& progress = {});

/// What a mesh can carry of its coating, as numbers at each vertex.
enum class CarriedCoating {
  displacement,  ///< coating_x, coating_y, coating_z: from the smooth surface to the mesh
  height,        ///< coating_height: its part along the smooth surface's normals
  laplacians,    ///< coating_x, coating_y, coating_z: its Laplacians, xi of the paper
};

/// The smooth mesh of `peeled`, which `request` made of `mesh`, with that much of its coating as
/// vertex properties, in place of any of the same names. Files of the mesh as it was read have no
/// room for them, so `source` is dropped.
Mesh with_coating(const Mesh& mesh, const PeelRequest& request, const Peeled& peeled,
                  CarriedCoating carried);

}  // namespace lapwing
