#pragma once

#include <array>
#include <cstdio>

#include "run/measure.h"
#include "window/app.h"

namespace lapwing::bench {

/// Frames of each kind in one counted run.
inline constexpr int kFramesPerRun = 8;

/// Times of the parts of a frame, in the order of the table.
struct FrameParts {
  std::array<Samples, 6> parts;

  void add(const viewer::FrameTimings& times, double frame_ms) {
    const std::array values{times.blend_ms, times.normals_ms, times.draw_ms,
                            times.ui_ms,    times.panels_ms,  frame_ms};
    for (std::size_t p = 0; p < values.size(); ++p) parts[p].milliseconds.push_back(values[p]);
  }

  void print(const char* title) const {
    constexpr std::array kNames{"blend, device",  "normals, device",   "surface, device",
                                "panels, device", "panels, processor", "whole frame"};
    std::printf("  %-48s %10s %10s %10s\n", title, "median", "min", "max");
    for (std::size_t p = 0; p < parts.size(); ++p) {
      std::printf("    %-46s %10.2f %10.2f %10.2f\n", kNames[p], parts[p].median(), parts[p].min(),
                  parts[p].max());
    }
    const double compute = parts[0].median() + parts[1].median();
    std::printf("    %-46s %10.3f\n", "compute / whole frame", compute / parts[5].median());
  }
};

}  // namespace lapwing::bench
