#pragma once

#include <algorithm>
#include <array>
#include <string>
#include <string_view>
#include <vector>

#include "report/report.h"

namespace lapwing::bench {

/// Whose work a report is about; everyone else in it is a peer.
inline constexpr std::string_view kOurselves = "Lapwing";

/// What the processor is called among the devices.
inline constexpr std::string_view kHostDevice = "CPU";

/// What comes before a preparation.
inline constexpr std::array<std::string_view, 4> kMeshStages{"read OBJ", "read PLY", "topology",
                                                             "check"};

/// What a preparation consists of, in its order.
inline constexpr std::array<std::string_view, 10> kPreparationStages{
    "pattern", "order",  "laplacian weights", "laplacian", "assemble", "normal matrix",
    "analyze", "factor", "response",          "upload"};

/// Of stages "kernel NAME", which only a device has.
inline bool is_kernel(std::string_view stage) {
  return stage.starts_with("kernel ");
}

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

/// Every different value of `part(measurement)`, in the order of the report.
template <class Part>
auto distinct(const Report& report, Part part) {
  std::vector<decltype(part(report.measurements.front()))> values;
  for (const Measurement& m : report.measurements) {
    const auto value = part(m);
    if (std::find(values.begin(), values.end(), value) == values.end()) values.push_back(value);
  }
  return values;
}

/// A row about each mesh and size, in the order of the report.
std::vector<const Measurement*> subjects_of(const Report& report);

/// The devices that anything was measured on.
std::vector<std::string> devices_of(const Report& report);

}  // namespace lapwing::bench
