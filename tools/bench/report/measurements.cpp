#include "report/measurements.h"

#include <algorithm>

namespace lapwing::bench {

const std::vector<double>& clock_of(const Measurement& measurement) {
  return measurement.wall_ms.empty() ? measurement.device_ms : measurement.wall_ms;
}

double median_ms(const Measurement& measurement) {
  return spread_of(clock_of(measurement)).median;
}

bool same_subject(const Measurement& a, const Measurement& b) {
  return a.mesh == b.mesh && a.vertices == b.vertices;
}

std::vector<const Measurement*> peers_of(const Report& report, const Measurement& ours) {
  std::vector<const Measurement*> peers;
  if (!is_ours(ours)) return peers;
  for (const Measurement& m : report.measurements) {
    if (!is_ours(m) && m.stage == ours.stage && same_subject(m, ours)) peers.push_back(&m);
  }
  return peers;
}

double ratio_to(const Measurement& ours, const Measurement& peer) {
  const double time = spread_of(ours.wall_ms).median;
  const double peer_time = spread_of(peer.wall_ms).median;
  return peer_time > 0.0 ? time / peer_time : 0.0;
}

std::vector<const Measurement*> subjects_of(const Report& report) {
  std::vector<const Measurement*> subjects;
  for (const Measurement& m : report.measurements) {
    const bool known = std::any_of(subjects.begin(), subjects.end(),
                                   [&](const Measurement* s) { return same_subject(*s, m); });
    if (!known) subjects.push_back(&m);
  }
  return subjects;
}

std::vector<std::string> devices_of(const Report& report) {
  std::vector<std::string> devices;
  for (const Measurement& m : report.measurements) {
    if (std::find(devices.begin(), devices.end(), m.device) == devices.end()) {
      devices.push_back(m.device);
    }
  }
  return devices;
}

}  // namespace lapwing::bench
