#pragma once

#include <string>

#include "lapwing/deform/deform.h"
#include "lapwing/deform/deform_request.h"
#include "lapwing/mesh/joined_surface.h"

namespace lapwing {

/// `request` over the surface with its seams joined, at its positions: regions are lists of leaders
/// (a belt by fraction stays one), targets are at leaders. Throws what `resolve` does.
DeformRequest joined_request(DeformRequest request, const JoinedSurface& joined);

/// Makes what came of such a request, `result` of the joined surface, that of `mesh`: followers are
/// where their leaders are and belong to the same regions, triangles are numbered as in `mesh`. A
/// note that begins with `where` says how many seam edges of the ROI were joined.
void give_back_seams(const JoinedSurface& joined, Mesh mesh, const std::string& where,
                     Deformed& result);

}  // namespace lapwing
