#pragma once

#include <array>
#include <string>
#include <vector>

#include "lapwing/mesh/mesh.h"
#include "lapwing/mesh/topology.h"

namespace lapwing {

/// The undirected edges of a mesh's polygons (not the diagonals that cut them into triangles), and
/// the polygon sides that lie on each. A side is named by the corner it starts from: side c goes
/// from `face_vertices[c]` to `face_vertices[next_corner[c]]`.
struct Edges {
  std::vector<std::array<Index, 2>> ends;  ///< lower vertex first, ascending
  Adjacency sides;                         ///< the sides on each edge, ascending
  std::vector<Index> edge_of_side;         ///< per corner; kNoIndex for a side from v to v
  std::vector<Index> next_corner;          ///< per corner: the next one in its polygon
  std::vector<Index> face_of_corner;       ///< per corner

  std::size_t count() const { return ends.size(); }
  bool is_boundary(std::size_t edge) const { return sides.size(edge) == 1; }
};

/// Collects the edges of the faces for which `use_face` is not 0. `use_face` has one entry per
/// face, or is empty for all faces. Near-linear time. Requires valid indices (`validate_indices`).
Edges build_edges(const Mesh& mesh, const std::vector<unsigned char>& use_face = {});

/// Returns the name of an edge in messages, such as "12-40".
std::string name_edge(Index a, Index b);

}  // namespace lapwing
