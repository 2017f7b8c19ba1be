#pragma once

#include <string>
#include <vector>

#include "report/report.h"

namespace lapwing::bench {

/// How the time of a stage grows with the mesh: median ms ~ factor * vertices^exponent.
struct Growth {
  std::string stage;
  std::string by;
  std::string device;
  double exponent = 0;
  double standard_error = 0;  ///< of the exponent, by how far the medians lie off the line
  double factor = 0;          ///< in ms
  std::size_t sizes = 0;      ///< different sizes that it was fitted to
};

/// By least squares on the logarithms of vertices and of medians (of wall time, device time for
/// kernels), for everything that was measured at three different sizes or more; in the order of the
/// report. Meshes smaller than 5,000 vertices are left out: there, constant costs such as a
/// submission to the device are most of the time, and bend the line.
std::vector<Growth> growths_of(const Report& report);

/// "n^1.48 +-0.03"
std::string in_words(const Growth& growth);

}  // namespace lapwing::bench
