#pragma once

#include <vector>

#include "lapwing/mesh/mesh.h"
#include "lapwing/remesh/original_patch.h"

namespace lapwing::remeshing {

/// Sets the kinds, sides, lines and sheets of `patch`, which was cut from `mesh`. Lines consist of
/// edges whose triangles meet at more than `angle_degrees` (except inside a polygon), and of edges
/// whose faces differ in material or group or, at the edge, in texture coordinates or stored
/// normals. Stored normals are ignored if they differ at more than half of the edges, because the
/// mesh is then flat-shaded. Lines end at fixed vertices: at the border, where the number of line
/// edges is not two, and at corners. At a corner, the line turns by more than 45 degrees, both
/// between its edges and between points at the distance `lengths[v]`, the target length, so that a
/// zigzag of short edges is not a corner.
void find_feature_lines(const Mesh& mesh, double angle_degrees, const std::vector<double>& lengths,
                        OriginalPatch& patch);

}  // namespace lapwing::remeshing
