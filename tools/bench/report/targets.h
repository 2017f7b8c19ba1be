#pragma once

#include <vector>

#include "report/report.h"

namespace lapwing::bench {

/// Compares `report` with the engine's targets: ratios of median wall times on the whole Armadillo
/// (26,002 vertices) and bounds on large meshes, for each device. Leaves out targets whose rows
/// were not measured.
std::vector<Target> targets_of(const Report& report);

}  // namespace lapwing::bench
