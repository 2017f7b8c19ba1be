#pragma once

#include <string>
#include <vector>

#include "lapwing/mesh/mesh.h"
#include "lapwing/region/vertex_set.h"

namespace lapwing {

/// A piece of a mesh with its attributes. Texture coordinates, normals, materials and groups that
/// only the rest of the mesh uses are removed. It has no source file.
struct CutPiece {
  Mesh mesh;
  std::vector<Index> vertices;  ///< vertex of `mesh` -> vertex of the original mesh
};

/// Returns a part: the polygons whose corners are all in `region`, and their vertices. Linear time.
/// Throws InputError, naming `where`, if there are no such polygons.
CutPiece cut_out(const Mesh& mesh, const VertexSet& region, const std::string& where);

/// Removes the polygons whose corners are all in `region` and returns the rest of the mesh: the
/// remaining polygons, their vertices, and all vertices outside the region. Linear time. Throws
/// InputError, naming `where`, if no polygon or every polygon is removed.
CutPiece cut_away(const Mesh& mesh, const VertexSet& region, const std::string& where);

}  // namespace lapwing
