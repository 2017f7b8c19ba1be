#pragma once

#include "report/report.h"

namespace lapwing::bench {

/// The machine that this runs on.
Host this_host();

/// Now, as ISO 8601 in UTC, to the second.
std::string now_utc();

/// The source that this was built from, as git described it when CMake last ran; "unknown" without.
std::string built_from();

}  // namespace lapwing::bench
