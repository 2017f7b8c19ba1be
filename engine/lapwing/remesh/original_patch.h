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
  fixed,  ///< stays: on the border, where lines meet or turn, or used by faces outside
};

/// The original triangles of the patch with compact vertex numbers ("own"). A mesh vertex where
/// several fans touch becomes one own vertex per fan. Two triangles are glued if they alone share
/// an edge that no face outside uses. All other edges are border.
struct OriginalPatch {
  KeepMask faces_outside;                     ///< per face of the mesh
  std::vector<Triangle> triangles;            ///< own numbers
  std::vector<std::array<Index, 3>> corners;  ///< per triangle: the mesh's corners
  std::vector<Index> faces;                   ///< per triangle: the mesh's face
  std::vector<Index> mesh_vertices;           ///< per own vertex
  std::vector<Index> next_copy;  ///< per own vertex: next one of the same mesh vertex, cyclic
  Positions positions;           ///< per own vertex
  std::vector<char> bound;       ///< per own vertex: on the border or used by faces outside
  std::vector<std::array<Index, 2>> outside_edges;  ///< as mesh vertices, sorted

  // `find_feature_lines` sets the rest. Until then there are no sides, and only bound vertices are
  // fixed.
  std::vector<VertexKind> kinds;  ///< per own vertex
  /// Sides 2 l and 2 l + 1 belong to line l; higher even numbers to the border's edges.
  Halfedges net;
  Adjacency lines;              ///< per line its half-edges on side 2 l, in order
  Adjacency sheets;             ///< triangles connected without crossing a line
  std::vector<Index> sheet_of;  ///< per triangle

  std::array<Eigen::Vector3d, 3> corner_positions(std::size_t t) const {
    const auto& [a, b, c] = triangles[t];
    return {positions[a], positions[b], positions[c]};
  }
};

/// Triangulates the faces of `mesh` whose corners are all in `region`. Throws InputError, naming
/// vertices, if one of them is not finite or a closed fan touches another one. Also throws it if
/// more than two triangles share an edge, or two traverse one in the same direction.
OriginalPatch cut_patch(const Mesh& mesh, const VertexSet& region);

}  // namespace lapwing::remeshing
