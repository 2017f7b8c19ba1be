#pragma once

#include <string>
#include <vector>

#include "lapwing/mesh/mesh.h"
#include "lapwing/region/boundary_loops.h"
#include "lapwing/transplant/zip.h"

namespace lapwing {

/// Two meshes that have become one.
struct Joined {
  Mesh mesh;  ///< the host's vertices first, then those of the part that were not welded
  std::vector<Index> part_vertices;  ///< number in the part -> number in `mesh`
  std::vector<Index> strip_faces;    ///< the zip's triangles
  std::vector<std::string> notes;    ///< what had to be left or made up, for a person
};

/// Host, part and the strip between them as one mesh: the faces of the host, of the part, of the
/// strip, in this order. Polygons stay polygons. Attributes of both are kept: texture coordinates,
/// normals, colours, materials (libraries and names merged), groups, extras. What only one has gets
/// a neutral value on the other (no texture coordinates, white, no material, no group, 0; the mean
/// of the faces' for normals stored per vertex) and a note.
///
/// The part's faces are in the group `group` (with groups of its own in "group/own"), the strip's
/// in `group`; an empty `group` leaves the part's groups as they are, and the strip's faces where
/// the face behind is. Strip faces take the other face attributes of the face behind the loop edge
/// they stand on, and there its corners' texture coordinates; the apex repeats those of the nearer
/// end, so that the texture is drawn out over the strip. Normals per corner come from both sides.
/// Welded vertices keep the host's position and vertex attributes. Comments of both; `uneditable`
/// is dropped and noted.
///
/// `zip` is that of the two loops. Throws InputError where a loop edge is not the side of one face
/// of its mesh, and what `validate_attributes` throws.
Joined join(const Mesh& host, const BoundaryLoop& host_loop, const Mesh& part,
            const BoundaryLoop& part_loop, const Zip& zip, const std::string& group);

}  // namespace lapwing
