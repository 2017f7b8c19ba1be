#pragma once

#include <string>

#include "lapwing/doctor/check.h"
#include "lapwing/doctor/fix.h"

namespace lapwing::viewer {

/// Returns the problems of `report`, without mere information, such as "2 non-finite vertices, 1
/// repeated face and 12,345 unwelded seam edges". Empty if there are none.
std::string problems_in_words(const CheckReport& report);

/// Returns one sentence: how the problems of `report` limit an edit.
std::string hindrance_in_words(const CheckReport& report);

/// Returns what was repaired: "12 vertices welded into another along seams, 1 repeated face
/// removed".
std::string repairs_in_words(const FixReport& report);

/// Describes a mesh in which nothing can be drawn or edited: what it holds, and the next step.
std::string emptiness_in_words(const std::string& name, const MeshStatistics& statistics);

}  // namespace lapwing::viewer
