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

/// Collects the edges of the faces of `mesh` for which `use_face` is not 0 (one entry per face;
/// empty: all faces). Sorts within the edges of each vertex: near-linear. Requires valid indices
/// (`validate_indices`).
Edges build_edges(const Mesh& mesh, const std::vector<unsigned char>& use_face = {});

/// "12-40", as messages name the edge between two vertices.
std::string name_edge(Index a, Index b);

}  // namespace lapwing
