#pragma once

#include "lapwing/remesh/isotropic.h"
#include "lapwing/remesh/working_patch.h"

namespace lapwing::remeshing {

/// `mesh` with the faces of the patch replaced by its triangles, and its attributes carried over
/// from where the new vertices, corners and faces lie on the original. Vertices and faces outside
/// come first, in their order.
RemeshResult carry_back(const Mesh& mesh, const WorkingPatch& patch);

}  // namespace lapwing::remeshing
