#pragma once

#include <span>
#include <string>
#include <vector>

#include "lapwing/mesh/mesh.h"
#include "lapwing/transplant/boundary_loops.h"
#include "lapwing/transplant/zip.h"

namespace lapwing {

/// Two meshes that have become one.
struct Joined {
  Mesh mesh;  ///< the host's vertices first, then those of the part that were not welded
  std::vector<Index> part_vertices;  ///< number in the part -> number in `mesh`
  std::vector<Index> strip_faces;    ///< the zip's triangles
  std::vector<std::string> notes;    ///< what had to be left or made up, for a person
};

/// Host, part and the strip between them as one mesh. Attributes of both are kept: texture
/// coordinates, normals, colours, materials (libraries and names merged), groups, extras; what only
/// one has gets a neutral value on the other (no UV, white, no material, 0) and a note. The part's
/// faces are in the group `group` (with the part's own groups as "group/own"), strip faces too, as
/// long as either has groups or `group` is not empty. Strip faces take face attributes of the face
/// behind the loop edge they stand on, and their corners UVs and normals of the corners there where
/// that is on the same side; else none. Welded vertices keep the host's position and vertex
/// attributes. Comments of both; `uneditable` is dropped and noted.
Joined join(const Mesh& host, const BoundaryLoop& host_loop, const Mesh& part,
            const BoundaryLoop& part_loop, const Zip& zip, const std::string& group);

}  // namespace lapwing
