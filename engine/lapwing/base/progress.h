#pragma once

#include <functional>
#include <string_view>

namespace lapwing {

/// Called when a stage of a long operation begins (`fraction` 0) and as it advances (up to 1).
/// `stage` is one of the names of the report's `timings_ms`. Return false to cancel: the
/// operation then throws `Cancelled` at the next stage boundary and leaves its inputs untouched.
using Progress = std::function<bool(std::string_view stage, double fraction)>;

/// Reports to `progress` if there is one. Throws `Cancelled` when it returns false.
void report_progress(const Progress& progress, std::string_view stage, double fraction);

}  // namespace lapwing
