#pragma once

#include <cstddef>
#include <string>

#include "studies/real/real_run.h"

namespace lapwing::bench {

inline RealOutcome outcome(std::size_t flipped_triangles, double largest_edge,
                           double detail_error) {
  RealOutcome made;
  made.measured = true;
  made.iterations = 12;
  made.flipped_triangles = flipped_triangles;
  made.largest_edge = largest_edge;
  made.detail_error = detail_error;
  made.edge_stretch = 0.25;
  made.prepare_ms = 3.5;
  made.solve_ms = 1.5;
  return made;
}

inline RealOutcome failed(const std::string& why) {
  RealOutcome made;
  made.failure = why;
  return made;
}

/// A run in which all is well.
inline RealRun good_run(const std::string& mesh) {
  return {mesh,
          "lift",
          2904,
          5804,
          7,
          "",
          outcome(0, 1.5, 0.02),
          outcome(0, 2.0, 0.1),
          outcome(0, 1.25, 0.03),
          outcome(0, 1.5, 0.025)};
}

}  // namespace lapwing::bench
