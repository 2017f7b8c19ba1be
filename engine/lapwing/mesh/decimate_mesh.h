#pragma once

#include <string>
#include <vector>

#include "lapwing/base/cancellation.h"
#include "lapwing/mesh/mesh.h"

namespace lapwing {

/// Options for reducing the number of vertices of a mesh.
struct DecimateRequest {
  double share = 0.5;              ///< fraction of the vertices to keep, above 0 and at most 1
  std::string where = "decimate";  ///< name in messages; ignored by ==
  bool operator==(const DecimateRequest& other) const { return share == other.share; }
};

struct DecimatedMesh {
  Mesh mesh;
  std::vector<Index> kept;  ///< per vertex: its number in the given mesh, ascending
};

/// Triangulates `mesh` and merges vertices until about `share` of those with faces are left
/// (decimate.h). The remaining vertices do not move. Vertices on unwelded seams, on seams of
/// texture coordinates, and between materials or groups are kept. Drops isolated vertices and
/// stored normals; all other attributes stay. Throws InputError, naming `request.where`, if the
/// share is out of range; InputError if the mesh has no surface or a vertex that is not finite; and
/// Cancelled. Stage "decimate".
DecimatedMesh decimate(const Mesh& mesh, const DecimateRequest& request,
                       const Progress& progress = {});

}  // namespace lapwing
