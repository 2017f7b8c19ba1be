#pragma once

#include <string>
#include <vector>

#include <Eigen/Geometry>

#include "lapwing/region/boundary_loops.h"
#include "lapwing/transplant/cut.h"
#include "lapwing/transplant/transplant_request.h"

namespace lapwing {

/// The hole that a target region leaves in a mesh.
struct Hole {
  std::vector<Triangle> triangles;  ///< the removed ones, in vertices of the mesh
  BoundaryLoop loop;                ///< their boundary, with them on its left, likewise
  CutPiece rest;
  BoundaryLoop rest_loop;  ///< the same loop reversed, from the same vertex, in vertices of `rest`
};

/// Cuts `region` from `mesh`. Throws InputError, naming the region, if it contains no whole face or
/// all of them, if its boundary is not one loop, or if it reaches the mesh's own boundary.
Hole cut_hole(const RegionSpec& region, const Mesh& mesh);

/// A part at its place on the host.
struct PlacedPart {
  Mesh mesh;
  BoundaryLoop loop;
  Eigen::Affine3d motion = Eigen::Affine3d::Identity();  ///< from its original place
  bool turned = false;                                   ///< it was inside out and is reversed
  std::vector<std::string> notes;                        ///< messages to the user
};

/// Cuts, turns and places the part of `request` from `source`. Throws InputError, naming the part,
/// if it lacks a boundary loop or the requested one, is not finite, or is flattened by its place.
PlacedPart place_part(const TransplantRequest& request, const Mesh& source, const Mesh& mesh,
                      const Hole& hole);

}  // namespace lapwing
