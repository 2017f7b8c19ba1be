#pragma once

#include <string>

#include "report/report.h"

namespace lapwing::bench {

/// The report as one HTML page that needs nothing else, with all plots and all numbers; light or
/// dark as the reader's system is, light on paper.
std::string page_of(const Report& report);

/// How times scale and what preparations consist of, for every device, as one picture (SVG) on
/// white that stands alone: for a README.
std::string plots_svg(const Report& report);

}  // namespace lapwing::bench
