#pragma once

#include <string>

#include "lapwing/doctor/check.h"
#include "lapwing/doctor/fix.h"

namespace lapwing {

// Text for a terminal: plain ASCII, no colours, each line ends with a newline.

/// The mesh's size and shape, one quantity a line.
std::string format(const MeshStatistics& statistics);

/// One line for each defect with severity, count and first places in aligned columns, followed by
/// what it means for editing and what to do; then a closing line that says how many can be
/// repaired.
std::string format(const CheckReport& report);

/// One line for each repair with its count.
std::string format(const FixReport& report);

}  // namespace lapwing
