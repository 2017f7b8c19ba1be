#pragma once

#include <span>

#include <Eigen/Core>

#include "lapwing/mesh/mesh.h"
#include "lapwing/patch/patch.h"

namespace lapwing {

/// `mesh` with `uvs`, one per own vertex of a patch of it, as texture coordinates on the corners of
/// the polygons that lie whole in the patch; all others have none, whatever they had before.
/// Polygons that hold a halved edge come out as the patch's triangles, with the midpoints as new
/// vertices behind the others: nothing but polygons on such an edge changes its shape.
Mesh with_uvs(const Mesh& mesh, const Patch& patch, std::span<const Eigen::Vector2d> uvs);

}  // namespace lapwing
