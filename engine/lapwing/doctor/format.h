#pragma once

#include <string>

#include "lapwing/doctor/check.h"
#include "lapwing/doctor/fix.h"

namespace lapwing {

// Text for a terminal: plain ASCII, no colours, each line ends with a newline.

/// Returns the mesh's size and shape, one quantity per line.
std::string format(const MeshStatistics& statistics);

/// Returns one line for each defect with severity, count and first places in aligned columns,
/// followed by its meaning for editing and the next step. A last line says how many kinds can be
/// repaired.
std::string format(const CheckReport& report);

/// Returns one line for each repair with its count.
std::string format(const FixReport& report);

}  // namespace lapwing
