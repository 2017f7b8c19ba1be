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
  double standard_error = 0;  ///< of the exponent, from the residuals of the fit
  double factor = 0;          ///< in ms
  std::size_t sizes = 0;      ///< number of different mesh sizes in the fit
};

/// Fits a line to the logarithms of vertices and median times (device time for kernels) by least
/// squares. Returns one Growth per stage that was measured at three different sizes or more, in the
/// order of the report. Leaves out meshes below 5,000 vertices, because constant costs such as a
/// submission to the device dominate there.
std::vector<Growth> growths_of(const Report& report);

/// "n^1.48 +-0.03"
std::string in_words(const Growth& growth);

}  // namespace lapwing::bench
