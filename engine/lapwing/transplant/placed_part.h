#pragma once

#include <string>
#include <vector>

#include <Eigen/Geometry>

#include "lapwing/region/boundary_loops.h"
#include "lapwing/transplant/cut.h"
#include "lapwing/transplant/transplant_request.h"

namespace lapwing {

/// The hole that the removal of a target region leaves in a mesh.
struct CutHole {
  std::vector<Triangle> triangles;  ///< the removed triangles, as vertices of the mesh
  BoundaryLoop loop;  ///< their boundary, with the triangles on its left, as vertices of the mesh
  CutPiece rest;
  BoundaryLoop rest_loop;  ///< `loop` reversed, with the same first vertex, as vertices of `rest`
};

/// Removes `region` from `mesh`. Throws InputError, naming the region, if it contains no whole face
/// or all faces, if its boundary is not one loop, or if it reaches the boundary of the mesh.
CutHole cut_hole(const RegionSpec& region, const Mesh& mesh);

/// A part in its final position on the host.
struct PlacedPart {
  Mesh mesh;
  BoundaryLoop loop;
  Eigen::Affine3d motion = Eigen::Affine3d::Identity();  ///< from the original position
  bool turned = false;             ///< whether its faces were reversed because it was inside out
  std::vector<std::string> notes;  ///< messages to the user
};

/// Cuts the part of `request` from `source`, reverses it if it is inside out, and places it. Throws
/// InputError, naming the part, if it lacks the boundary loop, is not finite, or becomes flat.
PlacedPart place_part(const TransplantRequest& request, const Mesh& source, const Mesh& mesh,
                      const CutHole& hole);

}  // namespace lapwing
