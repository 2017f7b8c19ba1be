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
  std::vector<Index> part_vertices;  ///< number in the part -> number in `mesh`
  std::vector<Index> strip_faces;    ///< the bridge's triangles
  std::vector<std::string> notes;    ///< messages about attributes that were dropped or filled in
};

/// Joins host, part and strip into one mesh, with their faces in this order. Polygons stay
/// polygons. The attributes of both are kept: texture coordinates, normals, colours, materials
/// (libraries and names merged), groups, extras. An attribute that only one mesh has gets a neutral
/// value on the other, and a note. Neutral values are no texture coordinates, white, no material,
/// no group and 0; normals stored per vertex become the mean of the face normals.
///
/// The part's faces join the group `group` ("group/own" if they had a group), the strip's faces
/// `group`. If `group` is empty, the part's groups stay as they are, and strip faces join the group
/// of the face behind. Strip faces copy their other attributes from the face behind their loop
/// edge, with the texture coordinates of its corners. The apex repeats the coordinates of the
/// nearer corner, which stretches the texture over the strip. Normals per corner come from both
/// sides. Welded vertices keep the host's position and vertex attributes. The comments of both are
/// kept; `uneditable` is dropped with a note.
///
/// `bridge` must be that of the two loops. Throws InputError if no face of its mesh has a loop edge
/// as a side, and what `validate_attributes` throws.
Joined join(const Mesh& host, const BoundaryLoop& host_loop, const Mesh& part,
            const BoundaryLoop& part_loop, const Bridge& bridge, const std::string& group);

}  // namespace lapwing
