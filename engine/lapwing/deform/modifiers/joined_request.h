#pragma once

#include <string>

#include "lapwing/deform/deform.h"
#include "lapwing/deform/deform_request.h"
#include "lapwing/mesh/seams.h"

namespace lapwing {

/// Returns `request` for the surface with joined seams. Regions become lists of leaders
/// (JoinedSurface), except a belt given as a fraction. Targets are assigned to leaders. Throws the
/// errors of `resolve`.
DeformRequest joined_request(DeformRequest request, const JoinedSurface& joined);

/// Converts the `result` of such a request from the joined surface to `mesh`. Followers get the
/// positions and regions of their leaders. Triangles get their indices in `mesh`. Adds a note that
/// begins with `where` and gives the number of joined seam edges in the ROI.
void give_back_seams(const JoinedSurface& joined, Mesh mesh, const std::string& where,
                     Deformed& result);

}  // namespace lapwing
