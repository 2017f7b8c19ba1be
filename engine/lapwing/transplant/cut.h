#pragma once

#include <string>
#include <vector>

#include "lapwing/mesh/mesh.h"
#include "lapwing/mesh/topology.h"
#include "lapwing/region/vertex_set.h"

namespace lapwing {

/// A piece of a mesh, with all of MeshAttributes that concerns it.
struct CutPiece {
  Mesh mesh;
  std::vector<Index> vertices;  ///< number in `mesh` -> number in the mesh it was cut from
};

/// The polygons all of whose corners are in `region`, with their vertices: a part. Throws
/// InputError, naming `where`, when there is none.
CutPiece cut_out(const Mesh& mesh, const VertexSet& region, const std::string& where);

/// All other polygons: what is left of the mesh around the hole. Vertices that only the part used
/// are gone; loose ones outside the region stay. Throws InputError, naming `where`, when nothing is
/// cut or nothing is left.
CutPiece cut_away(const Mesh& mesh, const VertexSet& region, const std::string& where);

}  // namespace lapwing
