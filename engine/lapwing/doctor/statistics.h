#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "lapwing/mesh/mesh.h"

namespace lapwing {

struct Edges;
struct Fans;
struct Orientation;

/// Size and shape of a mesh. Edges are polygon edges, without the diagonals of the triangulation.
/// Faces without a proper triangle count only in `faces`.
struct MeshStatistics {
  std::size_t vertices = 0;
  std::size_t faces = 0;
  std::size_t triangles = 0;
  std::size_t edges = 0;
  std::size_t boundary_edges = 0;
  std::size_t boundary_loops = 0;
  /// Numbers of vertices, largest first; without loose vertices.
  std::vector<std::size_t> component_sizes;
  long euler_characteristic = 0;  ///< vertices on faces - edges + faces
  /// Sum over the components. Empty if the surface is one-sided or has non-manifold edges or
  /// bow-tie vertices.
  std::optional<long> genus;
  double min_edge_length = 0.0;  ///< over edges with finite ends; 0 without edges
  double mean_edge_length = 0.0;
  double max_edge_length = 0.0;
  Bounds bounds;
  double area = 0.0;  ///< over triangles with finite corners
};

/// Measures `mesh`. The other arguments must have been computed from `mesh`.
MeshStatistics measure(const Mesh& mesh, const Edges& edges, const Fans& fans,
                       const Orientation& orientation);

}  // namespace lapwing
