#pragma once

#include "lapwing/mesh/mesh.h"
#include "studies/studies.h"

namespace lapwing::bench {

/// Opens the mesh in the whole viewer, on images that no display holds up, and prints what its
/// frames cost while the cursor goes over the panels and while a drag turns the view. ImGui must
/// have no context.
void print_viewer_frames(const FrameBench& settings, const Mesh& mesh);

}  // namespace lapwing::bench
