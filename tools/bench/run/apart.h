#pragma once

#include <functional>
#include <string>
#include <string_view>

#include "report/report.h"

namespace lapwing::bench {

/// The output of a child process, and how it ended.
struct Told {
  std::string text;
  std::string failure;  ///< exception, signal or time limit that ended it; empty on success
};

/// Runs `work` in a forked copy of this process, for at most `most_seconds` (0: no limit). Returns
/// the text that it passed to `tell` by then, which must not contain NUL. This process must not
/// have opened a device or used several threads before. Throws Error if the process cannot be
/// started.
Told run_in_child_process(
    const std::function<void(const std::function<void(std::string_view)>& tell)>& work,
    double most_seconds = 0.0);

/// Runs `work` in a forked copy of this process and returns its report. Memory fragmentation,
/// caches and threads then do not affect the next measurement, and a crash does not lose the other
/// results. The copy shares standard error. This process must not have opened a device. Throws
/// Error with the message of an exception of `work`, or with one that says how the process ended.
Report report_from_child_process(const std::function<Report()>& work);

}  // namespace lapwing::bench
