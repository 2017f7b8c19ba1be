#pragma once

#include <string>

#include "lapwing/doctor/check.h"
#include "lapwing/doctor/fix.h"

namespace lapwing {

// Text for a terminal: ASCII without colours; each line ends with a newline.

/// Returns the statistics, one quantity per line.
std::string format(const MeshStatistics& statistics);

/// Returns, for each defect, one line with severity, count and first elements in aligned columns,
/// followed by its meaning for editing and the next step. The last line contains the number of
/// kinds that can be repaired.
std::string format(const CheckReport& report);

/// Returns one line for each kind of repair with its count.
std::string format(const FixReport& report);

}  // namespace lapwing
