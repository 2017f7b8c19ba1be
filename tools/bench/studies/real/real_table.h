#pragma once

#include <string>

#include "studies/real/real_run.h"
#include "studies/real/real_summary.h"

namespace lapwing::bench {

/// Two lines above `line_of`'s.
std::string real_heading();

/// One run in one line: our default result, the linear response alone, ARAP; at the end why one of
/// them is not there. A star stands for iterations that ran out.
std::string line_of(const RealRun& run);

/// The figures and what each does not hold for, what failed, what was passed over: for a terminal.
std::string text_of(const RealReport& report);

/// Figures and the table of all runs, in Markdown.
std::string markdown_of(const RealReport& report);

}  // namespace lapwing::bench
