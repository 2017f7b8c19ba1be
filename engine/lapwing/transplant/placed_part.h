#pragma once

#include <string>
#include <vector>

#include <Eigen/Geometry>

#include "lapwing/region/boundary_loops.h"
#include "lapwing/transplant/cut.h"
#include "lapwing/transplant/transplant_request.h"

namespace lapwing {

/// What a target region leaves behind.
struct Hole {
  std::vector<Triangle> triangles;  ///< that go, numbers of the mesh
  BoundaryLoop loop;                ///< their boundary, with them on its left, numbers of the mesh
  CutPiece rest;
  BoundaryLoop rest_loop;  ///< the same run through the other way, from the same vertex, of `rest`
};

/// Cuts `region` from `mesh`. Throws InputError, naming the region, when it holds no whole face or
/// all of them, when its boundary is not one loop, and when it reaches the mesh's own boundary.
Hole cut_hole(const RegionSpec& region, const Mesh& mesh);

/// A part where it belongs.
struct PlacedPart {
  Mesh mesh;
  BoundaryLoop loop;
  Eigen::Affine3d motion = Eigen::Affine3d::Identity();  ///< from where it was given
  bool turned = false;                                   ///< it was inside out
  std::vector<std::string> notes;                        ///< for a person
};

/// Cuts, turns and places the part of `request`, from `source`. Throws InputError, naming the part:
/// one without boundary loop or without the one that is wanted, a place that flattens it.
PlacedPart place_part(const TransplantRequest& request, const Mesh& source, const Mesh& mesh,
                      const Hole& hole);

}  // namespace lapwing
