#pragma once

#include "lapwing/base/progress.h"
#include "lapwing/base/stopwatch.h"

namespace lapwing {

/// Runs `body` as a stage: reports it to `progress` and adds its time to `timings`.
template <typename Body>
void stage(const char* name, StageTimings& timings, const Progress& progress, Body body) {
  report_progress(progress, name, 0.0);
  const Stopwatch watch;
  body();
  timings.add(name, watch.elapsed_ms());
}

}  // namespace lapwing
