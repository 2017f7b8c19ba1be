#pragma once

#include <span>

#include <Eigen/Core>

#include "lapwing/mesh/mesh.h"
#include "lapwing/patch/patch.h"

namespace lapwing {

/// Returns `mesh` with `uvs`, one per own number of a patch of it, as texture coordinates on the
/// corners of the polygons that lie wholly in the patch. All other corners lose theirs. Polygons
/// with a halved edge are replaced by the patch's triangles, with the midpoints as new vertices
/// after the others. No other polygon changes its shape.
Mesh with_uvs(const Mesh& mesh, const Patch& patch, std::span<const Eigen::Vector2d> uvs);

}  // namespace lapwing
