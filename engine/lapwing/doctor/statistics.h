#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "lapwing/mesh/mesh.h"

namespace lapwing {

struct Edges;
struct Fans;
struct Orientation;

/// Size and shape of a mesh. Edges are those of its polygons, without the diagonals that cut them
/// into triangles. Faces without a proper triangle count only in `faces`.
struct MeshStatistics {
  std::size_t vertices = 0;
  std::size_t faces = 0;
  std::size_t triangles = 0;
  std::size_t edges = 0;
  std::size_t boundary_edges = 0;
  std::size_t boundary_loops = 0;
  std::vector<std::size_t> component_sizes;  ///< in vertices, largest first; loose ones left out
  long euler_characteristic = 0;             ///< vertices on faces - edges + faces
  /// Sum over the components. Empty unless the surface is two-sided and has neither non-manifold
  /// edges nor bow-ties.
  std::optional<long> genus;
  double min_edge_length = 0.0;  ///< over edges with finite ends; 0 without edges
  double mean_edge_length = 0.0;
  double max_edge_length = 0.0;
  Bounds bounds;
  double area = 0.0;  ///< over triangles with finite corners
};

/// Measures `mesh`; the other arguments must be those of `mesh`.
MeshStatistics measure(const Mesh& mesh, const Edges& edges, const Fans& fans,
                       const Orientation& orientation);

}  // namespace lapwing
