#pragma once

#include <string>

#include "lapwing/step/run_report.h"

namespace lapwing {

/// Returns the report as indented JSON, with keys in a fixed order. Numbers that are not finite
/// become null.
std::string to_json(const RunReport& report);

/// Returns the stages of the run and of each step with their milliseconds, as lines for a terminal.
std::string format_stages(const RunReport& report);

}  // namespace lapwing
