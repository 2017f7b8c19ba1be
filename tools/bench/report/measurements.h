#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "report/report.h"

namespace lapwing::bench {

/// Whose work a report is about; everyone else in it is a peer.
inline constexpr std::string_view kOurselves = "Lapwing";

/// The wall's, or the device's own where only that was read: of the kernels that a stage ran.
const std::vector<double>& clock_of(const Measurement& measurement);
double median_ms(const Measurement& measurement);  ///< by that clock

inline bool is_ours(const Measurement& measurement) {
  return measurement.by == kOurselves;
}

/// Both are about one mesh at one size.
bool same_subject(const Measurement& a, const Measurement& b);

/// Who else did the work of one of our measurements, on whichever device; none for a peer's own.
std::vector<const Measurement*> peers_of(const Report& report, const Measurement& ours);

/// Our median wall time over a peer's: below 1 where we are faster. 0 where either has none.
double ratio_to(const Measurement& ours, const Measurement& peer);

/// A row about each mesh and size, in the order of the report.
std::vector<const Measurement*> subjects_of(const Report& report);

/// The devices that anything was measured on.
std::vector<std::string> devices_of(const Report& report);

}  // namespace lapwing::bench
