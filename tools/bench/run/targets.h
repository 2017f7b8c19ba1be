#pragma once

#include <vector>

#include "report/report.h"

namespace lapwing::bench {

/// What the engine is held to, of what `report` has measured, on the whole Armadillo (26,002
/// vertices), on large meshes and over all sizes: ratios of medians of wall time, and each device
/// by itself. Targets whose rows were not measured are left out.
std::vector<Target> targets_of(const Report& report);

}  // namespace lapwing::bench
