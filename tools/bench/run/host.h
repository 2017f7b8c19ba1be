#pragma once

#include "report/report.h"

namespace lapwing::bench {

/// Describes this machine.
Host this_host();

/// Returns the current time as ISO 8601 in UTC, to the second.
std::string now_utc();

/// Returns the source revision as git described it when CMake last ran, or "unknown".
std::string built_from();

}  // namespace lapwing::bench
