#pragma once

#include <string>

#include "report/report.h"

namespace lapwing::bench {

/// Parts of the page, as HTML; "" where the report has nothing for them.
std::string host_html(const Report& report);     ///< when, of what and where, and the devices
std::string targets_html(const Report& report);  ///< what was asked for, and whether it is met
std::string growths_html(const Report& report);
std::string measurements_html(const Report& report);  ///< every measurement

}  // namespace lapwing::bench
