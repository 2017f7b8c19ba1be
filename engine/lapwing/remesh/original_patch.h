#pragma once

#include <array>
#include <vector>

#include "lapwing/mesh/compact.h"
#include "lapwing/region/vertex_set.h"
#include "lapwing/remesh/halfedges.h"

namespace lapwing::remeshing {

enum class VertexKind : unsigned char {
  free,   ///< moves on its sheet
  line,   ///< moves along its line
  fixed,  ///< does not move: on the border, where lines meet or turn, or used by faces outside
};

/// The original triangles of the patch with local vertex indices. A mesh vertex with several fans
/// of triangles has one local index per fan. Two triangles are adjacent if only they use an edge.
/// All other edges are border.
struct OriginalPatch {
  KeepMask faces_outside;                     ///< per face of the mesh
  std::vector<Triangle> triangles;            ///< local indices
  std::vector<std::array<Index, 3>> corners;  ///< per triangle: corners of the mesh
  std::vector<Index> faces;                   ///< per triangle: face of the mesh
  std::vector<Index> mesh_vertices;           ///< per local vertex
  std::vector<Index> next_copy;  ///< per local vertex: next one of the same mesh vertex, cyclic
  Positions positions;           ///< per local vertex
  std::vector<char> bound;       ///< per local vertex: is on the border or used outside
  std::vector<std::array<Index, 2>> outside_edges;  ///< as mesh vertices, sorted

  // `find_feature_lines` sets the remaining members. Before this call, there are no sides, and only
  // bound vertices are fixed.
  std::vector<VertexKind> kinds;  ///< per local vertex
  /// Sides 2 l and 2 l + 1 belong to line l, and larger even indices to the border edges.
  Halfedges net;
  Adjacency lines;              ///< per line l: its half-edges on side 2 l, in order
  Adjacency sheets;             ///< sets of triangles that are connected without crossing a line
  std::vector<Index> sheet_of;  ///< per triangle

  std::array<Eigen::Vector3d, 3> corner_positions(std::size_t t) const {
    const auto& [a, b, c] = triangles[t];
    return {positions[a], positions[b], positions[c]};
  }
};

/// Triangulates the faces of `mesh` whose corners are all in `region`. Throws InputError, naming
/// vertices, if a position is not finite, a vertex has a closed fan and another fan, more than two
/// triangles share an edge, or two triangles traverse an edge in the same direction.
OriginalPatch cut_patch(const Mesh& mesh, const VertexSet& region);

}  // namespace lapwing::remeshing
