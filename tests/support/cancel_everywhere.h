#pragma once

#include <cstddef>

#include <gtest/gtest.h>

#include "lapwing/base/cancellation.h"
#include "lapwing/base/errors.h"

namespace lapwing::test {

/// Calls `run(progress)` again and again, cancelled at another point of it each time, and then lets
/// it end: every check in a loop is a point here. The first sixteen are all taken, farther on every
/// sixteenth part of the way, so that some hundred runs see all stages however many points there
/// are. Returns how many there were before the end.
template <class Run>
std::size_t cancel_everywhere(const Run& run) {
  const AskAtEveryCheck asking;
  for (std::size_t point = 1;; point += 1 + point / 16) {
    std::size_t asked = 0;
    const Progress progress = [&](std::string_view, double) { return ++asked != point; };
    try {
      run(progress);
    } catch (const Cancelled&) {
      EXPECT_GE(asked, point);
      continue;
    }
    // What is asked on the way out of a helper's work may come after the last point.
    EXPECT_LT(asked, point) << "was told to stop and went on";
    return asked;
  }
}

}  // namespace lapwing::test
