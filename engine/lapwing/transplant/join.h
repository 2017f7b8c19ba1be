#pragma once

#include <string>
#include <vector>

#include "lapwing/mesh/mesh.h"
#include "lapwing/region/boundary_loops.h"
#include "lapwing/transplant/bridge.h"

namespace lapwing {

/// Two meshes joined into one.
struct Joined {
  Mesh mesh;  ///< the host's vertices first, then those of the part that were not welded
  std::vector<Index> part_vertices;  ///< vertex of the part -> vertex of `mesh`
  std::vector<Index> strip_faces;    ///< the bridge's triangles
  std::vector<std::string> notes;    ///< messages about attributes that were removed or filled in
};

/// Joins host, part and strip into one mesh, with their faces in this order. Polygons are not
/// triangulated. All attributes of both meshes are preserved: texture coordinates, normals,
/// colours, materials (with merged libraries and names), groups, extras. If only one mesh has an
/// attribute, the other gets a neutral value, and a note is added. Neutral values are no texture
/// coordinates, white, no material, no group and 0; for normals per vertex, the mean of the face
/// normals.
///
/// Faces of the part get the group `group` ("group/own" if they have a group), faces of the strip
/// `group`. If `group` is empty, the part's groups do not change, and a strip face gets the group
/// of the mesh face at its loop edge. The other attributes of a strip face are copied from that
/// mesh face. The apex of a strip face repeats the texture coordinates of the nearer corner, which
/// stretches the texture over the strip. Normals per corner are copied from both meshes. Welded
/// vertices have the host's position and vertex attributes. The comments of both files are
/// preserved; `uneditable` is removed with a note.
///
/// `bridge` must be the result of bridge_loops for the two loops. Throws InputError if a loop edge
/// is not an edge of a face, and the errors of `validate_attributes`.
Joined join(const Mesh& host, const BoundaryLoop& host_loop, const Mesh& part,
            const BoundaryLoop& part_loop, const Bridge& bridge, const std::string& group);

}  // namespace lapwing
