#pragma once

#include "lapwing/remesh/isotropic.h"
#include "lapwing/remesh/working_patch.h"

namespace lapwing::remeshing {

/// Returns `mesh` with the faces of the patch replaced by its triangles. New vertices, corners and
/// faces get the attributes of their points on the original mesh. Vertices and faces outside the
/// patch come first, in the same order.
RemeshResult transfer_to_mesh(const Mesh& mesh, const WorkingPatch& patch);

}  // namespace lapwing::remeshing
