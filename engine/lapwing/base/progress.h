#pragma once

#include <functional>
#include <string_view>

namespace lapwing {

/// Called when a stage of a long operation begins (`fraction` 0), as it advances (up to 1), and
/// about every 20 ms meanwhile with what it was told last, to ask whether to go on. `stage` is one
/// of the names of the report's `timings_ms`, or empty before the first. Return false to cancel:
/// the operation then throws `Cancelled` and leaves its inputs untouched, soon: within 0.2 s on
/// meshes of 400,000 vertices and two cores.
using Progress = std::function<bool(std::string_view stage, double fraction)>;

/// Reports to `progress` if there is one; else asks the ProgressScope in force (cancellation.h).
/// Throws `Cancelled` when the answer is false.
void report_progress(const Progress& progress, std::string_view stage, double fraction);

}  // namespace lapwing
