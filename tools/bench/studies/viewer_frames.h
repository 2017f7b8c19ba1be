#pragma once

#include "lapwing/mesh/mesh.h"
#include "studies/studies.h"

namespace lapwing::bench {

/// Opens the mesh in the whole viewer, drawn offscreen. Prints the cost of its frames while the
/// cursor moves over the panels and while a drag turns the view. ImGui must have no context.
void print_viewer_frames(const FrameBench& settings, const Mesh& mesh);

}  // namespace lapwing::bench
