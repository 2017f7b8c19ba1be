#pragma once

#include <string>

#include "lapwing/step/run_report.h"

namespace lapwing {

/// The report as JSON, indented, keys in a fixed order. Numbers that are not finite become null.
std::string to_json(const RunReport& report);

/// The stages of the run and of each step with their milliseconds, as lines for a terminal.
std::string format_stages(const RunReport& report);

}  // namespace lapwing
