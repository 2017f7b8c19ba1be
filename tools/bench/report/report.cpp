#include "report/report.h"

#include <algorithm>
#include <cmath>

namespace lapwing::bench {
namespace {

// Interpolates linearly between the two numbers next to the quantile.
double quantile(const std::vector<double>& sorted, double share) {
  const double place = share * static_cast<double>(sorted.size() - 1);
  const auto below = static_cast<std::size_t>(place);
  const std::size_t above = std::min(below + 1, sorted.size() - 1);
  return std::lerp(sorted[below], sorted[above], place - static_cast<double>(below));
}

// Returns the rate of `count` over `ms` milliseconds, as a share of `limit` (1e9 per second).
double share(const Counts& counts, const std::string& count, double ms, double limit) {
  const auto found = counts.find(count);
  if (found == counts.end() || !(ms > 0.0) || !(limit > 0.0)) return 0.0;
  return static_cast<double>(found->second) / (ms * 1e6) / limit;
}

}  // namespace

Spread spread_of(std::vector<double> numbers) {
  if (numbers.empty()) return {};
  std::sort(numbers.begin(), numbers.end());
  return {quantile(numbers, 0.5), quantile(numbers, 0.25), quantile(numbers, 0.75)};
}

bool same_subject(const Measurement& a, const Measurement& b) {
  return a.mesh == b.mesh && a.vertices == b.vertices;
}

std::vector<const Measurement*> peers_of(const Report& report, const Measurement& ours) {
  std::vector<const Measurement*> peers;
  if (!ours.is_ours()) return peers;
  for (const Measurement& m : report.measurements) {
    if (!m.is_ours() && m.stage == ours.stage && same_subject(m, ours)) peers.push_back(&m);
  }
  return peers;
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

const Limits* limits_of(const Report& report, const Measurement& measurement) {
  const auto found =
      std::find_if(report.limits.begin(), report.limits.end(),
                   [&](const Limits& limits) { return limits.device == measurement.device; });
  return found == report.limits.end() ? nullptr : &*found;
}

double share_of_limit(const Report& report, const Measurement& measurement) {
  const Limits* const limits = limits_of(report, measurement);
  if (limits == nullptr) return 0.0;
  const double ms = median_of(measurement.clock_ms());
  return std::max(share(measurement.counts, "flops", ms, limits->matmul_gflops_float64),
                  share(measurement.counts, "bytes", ms, limits->copy_gb_per_s));
}

}  // namespace lapwing::bench
