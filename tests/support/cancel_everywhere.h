#pragma once

#include <cstddef>

#include <gtest/gtest.h>

#include "lapwing/base/cancellation.h"
#include "lapwing/base/errors.h"

namespace lapwing::test {

/// Calls `run(progress)` repeatedly and cancels each run at a later check point than the previous
/// run, until a run completes. Uses each of the first sixteen points. After that, each point is a
/// sixteenth farther than the one before, so that about a hundred runs reach all stages. Returns
/// the number of points.
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
    // A helper thread may reach further check points after the last counted one.
    EXPECT_LT(asked, point) << "was told to stop and went on";
    return asked;
  }
}

}  // namespace lapwing::test
