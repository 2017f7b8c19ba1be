#pragma once

#include <string>
#include <vector>

#include "lapwing/mesh/mesh.h"
#include "lapwing/region/vertex_set.h"

namespace lapwing {

/// A piece of a mesh, with what MeshAttributes has of it: no texture coordinate, normal, material
/// or group that only the rest of the mesh uses. Knows no source file.
struct CutPiece {
  Mesh mesh;
  std::vector<Index> vertices;  ///< number in `mesh` -> number in the mesh it was cut from
};

/// The polygons all of whose corners are in `region`, with their vertices: a part. Linear time.
/// Throws InputError, naming `where`, when there is none.
CutPiece cut_out(const Mesh& mesh, const VertexSet& region, const std::string& where);

/// All other polygons: what is left of the mesh around the hole. With every vertex that they have,
/// and every other that is not in the region. Linear time. Throws InputError, naming `where`, when
/// nothing is cut or nothing is left.
CutPiece cut_away(const Mesh& mesh, const VertexSet& region, const std::string& where);

}  // namespace lapwing
