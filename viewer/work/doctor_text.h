#pragma once

#include <string>

#include "lapwing/doctor/check.h"
#include "lapwing/doctor/fix.h"

namespace lapwing::viewer {

/// Returns the warnings and errors of `report`, for example "2 non-finite vertices, 1 repeated face
/// and 12,345 unwelded seam edges". Empty if there are none.
std::string problems_in_words(const CheckReport& report);

/// Returns one sentence about how the problems of `report` restrict edits.
std::string hindrance_in_words(const CheckReport& report);

/// Returns a list of the repairs, for example "12 vertices welded into another along seams, 1
/// repeated face removed".
std::string repairs_in_words(const FixReport& report);

/// Describes the contents of a mesh that cannot be drawn or edited, and suggests the next step.
std::string emptiness_in_words(const std::string& name, const MeshStatistics& statistics);

}  // namespace lapwing::viewer
