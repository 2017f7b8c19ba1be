#pragma once

#include <vector>

#include "lapwing/mesh/mesh.h"
#include "lapwing/remesh/original_patch.h"

namespace lapwing::remeshing {

/// Sets the kinds, sides, lines and sheets of `patch`, cut from `mesh`. Lines run along edges whose
/// triangles meet at more than `angle_degrees` (except inside a polygon). They also run where faces
/// differ in material or group or, at the edge, in texture coordinates or stored normals. If
/// normals differ at more than half of the edges, the mesh is just flat-shaded and they do not
/// count. Lines end at fixed vertices: on the border, where not exactly two line edges meet, and at
/// corners. At a corner, the line turns by more than 45 degrees, both at the vertex and between
/// points `lengths` (per own vertex, the target) away. The zigzag of a line along short edges is no
/// corner.
void find_feature_lines(const Mesh& mesh, double angle_degrees, const std::vector<double>& lengths,
                        OriginalPatch& patch);

}  // namespace lapwing::remeshing
