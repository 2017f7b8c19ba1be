#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "report/report.h"

namespace lapwing::bench {

/// The value of Measurement::by in our rows. All other rows are peers'.
inline constexpr std::string_view kOurselves = "Lapwing";

/// Returns the wall times or, if there are none, the device times (rows of kernels).
const std::vector<double>& clock_of(const Measurement& measurement);
double median_ms(const Measurement& measurement);  ///< of `clock_of`

inline bool is_ours(const Measurement& measurement) {
  return measurement.by == kOurselves;
}

/// Returns whether both rows are about the same mesh at the same size.
bool same_subject(const Measurement& a, const Measurement& b);

/// Returns the peers' rows of the same stage and mesh, on any device; none if `ours` is a peer's
/// row.
std::vector<const Measurement*> peers_of(const Report& report, const Measurement& ours);

/// Returns our median wall time over the peer's: below 1 if we are faster, 0 if either has none.
double ratio_to(const Measurement& ours, const Measurement& peer);

/// Returns one row for each mesh and size, in the order of the report.
std::vector<const Measurement*> subjects_of(const Report& report);

/// Returns the devices of all rows, in the order of the report.
std::vector<std::string> devices_of(const Report& report);

}  // namespace lapwing::bench
