#pragma once

#include "lapwing/remesh/isotropic.h"
#include "lapwing/remesh/working_patch.h"

namespace lapwing::remeshing {

/// Returns `mesh` with the faces of the patch replaced by its triangles. New vertices, corners and
/// faces get their attributes from their places on the original. Vertices and faces outside come
/// first, in the old order.
RemeshResult transfer_to_mesh(const Mesh& mesh, const WorkingPatch& patch);

}  // namespace lapwing::remeshing
