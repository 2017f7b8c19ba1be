#pragma once

#include <vector>

#include "lapwing/mesh/mesh.h"
#include "lapwing/remesh/original_patch.h"

namespace lapwing::remeshing {

/// Fills in the kinds, sides, lines and sheets of `patch`, cut from `mesh`. Lines run along edges
/// whose triangles meet at more than `angle_degrees` (but inside a polygon), or whose faces differ
/// in material, group or, at the edge, in texture coordinates or stored normals. Where most edges
/// have different normals on their two sides, the mesh is merely shaded flat, and none counts. They
/// end at fixed vertices: on the
/// border, where other than two of their edges meet, and where they turn by more than 45 degrees,
/// both at the vertex and when seen `lengths` (per own vertex, the target) apart: the zigzag of a
/// line along short edges is no corner.
void find_feature_lines(const Mesh& mesh, double angle_degrees, const std::vector<double>& lengths,
                        OriginalPatch& patch);

}  // namespace lapwing::remeshing
