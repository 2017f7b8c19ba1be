#pragma once

#include <string>

#include "studies/real/real_run.h"
#include "studies/real/real_summary.h"

namespace lapwing::bench {

/// Returns the two heading lines of a table of `line_of`.
std::string real_heading();

/// Returns one run as one line: our default result, the linear response alone, ARAP, Smooth ARAP
/// and the reasons for missing results. A star marks iterations that ran out.
std::string line_of(const RealRun& run);

/// Returns the summary for a terminal: figures with exceptions, failures and files passed over.
std::string text_of(const RealReport& report);

/// Returns the figures and the table of all runs in Markdown.
std::string markdown_of(const RealReport& report);

}  // namespace lapwing::bench
