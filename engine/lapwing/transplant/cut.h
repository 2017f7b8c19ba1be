#pragma once

#include <string>
#include <vector>

#include "lapwing/mesh/mesh.h"
#include "lapwing/region/vertex_set.h"

namespace lapwing {

/// A piece of a mesh with its attributes, except texture coordinates, normals, materials and groups
/// that only the rest of the mesh uses. It has no source file.
struct CutPiece {
  Mesh mesh;
  std::vector<Index> vertices;  ///< number in `mesh` -> number in the mesh it was cut from
};

/// Cuts out a part: the polygons whose corners are all in `region`, with their vertices. Linear
/// time. Throws InputError, naming `where`, if there are none.
CutPiece cut_out(const Mesh& mesh, const VertexSet& region, const std::string& where);

/// Cuts the same polygons away and returns the rest of the mesh, around the hole. It keeps the
/// vertices of the remaining polygons and all vertices outside the region. Linear time. Throws
/// InputError, naming `where`, if nothing is cut or nothing is left.
CutPiece cut_away(const Mesh& mesh, const VertexSet& region, const std::string& where);

}  // namespace lapwing
