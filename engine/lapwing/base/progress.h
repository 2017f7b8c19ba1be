#pragma once

#include <functional>
#include <string_view>

namespace lapwing {

/// Called when a stage of a long operation begins (`fraction` 0) and as it advances (up to 1). In
/// between it is called about every 20 ms with its last arguments. `stage` is a name in the
/// report's `timings_ms`, or empty before the first stage. Return false to cancel: the operation
/// throws `Cancelled` and leaves its inputs unchanged, within 0.2 s on meshes of 400,000 vertices
/// and two cores.
using Progress = std::function<bool(std::string_view stage, double fraction)>;

/// Calls `progress`, or if that is empty checks the current ProgressScope (cancellation.h). Throws
/// `Cancelled` if the answer is false.
void report_progress(const Progress& progress, std::string_view stage, double fraction);

}  // namespace lapwing
