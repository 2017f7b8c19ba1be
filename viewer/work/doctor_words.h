#pragma once

#include <string>

#include "lapwing/doctor/check.h"
#include "lapwing/doctor/fix.h"

namespace lapwing::viewer {

/// "2 non-finite vertices, 1 repeated face and 12,345 unwelded seam edges": the problems of
/// `report`, what is only worth knowing left out. Empty where there is none.
std::string problems_in_words(const CheckReport& report);

/// One sentence: what the problems of `report` keep an edit from.
std::string hindrance_in_words(const CheckReport& report);

/// "12 vertices welded into another along seams, 1 repeated face removed": what was repaired.
std::string repairs_in_words(const FixReport& report);

/// Of a mesh in which nothing can be drawn or edited: what it holds, and the next step.
std::string emptiness_in_words(const std::string& name, const MeshStatistics& statistics);

}  // namespace lapwing::viewer
