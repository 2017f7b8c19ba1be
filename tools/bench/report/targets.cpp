#include "report/targets.h"

#include <algorithm>
#include <array>
#include <string>

namespace lapwing::bench {
namespace {

constexpr const char* kArap = "CGAL ARAP";
constexpr std::size_t kLarge = 200'000;      // vertices; exceeds every cache
constexpr std::size_t kMillion = 1'000'000;  // vertices

const Measurement* find(const Report& report, const std::string& stage, const std::string& by,
                        const std::string& device, const std::string& mesh) {
  for (const Measurement& m : report.measurements) {
    if (m.stage == stage && m.by == by && m.device == device && m.mesh == mesh) return &m;
  }
  return nullptr;
}

// Limits one of our stages over another row to `at_most`.
struct RatioTarget {
  const char* stage;
  const char* beside;
  const char* by;
  double at_most;
};
constexpr std::array kRatios{
    RatioTarget{"preparation", "preparation", kArap, 1.0},
    RatioTarget{"settled preparation", "preparation", kArap, 1.0},
    RatioTarget{"first drag", "preparation", kArap, 0.25},
    RatioTarget{"order", "preparation", kLapwing, 0.2},
    RatioTarget{"again, other handle", "preparation", kLapwing, 0.3},
    RatioTarget{"again, other belt", "preparation", kLapwing, 0.3},
    RatioTarget{"again, other weight", "preparation", kLapwing, 0.3},
    RatioTarget{"again, other Laplacians", "preparation", kLapwing, 0.3},
    RatioTarget{"settled again, other handle", "settled preparation", kLapwing, 0.3},
    RatioTarget{"settled again, other belt", "settled preparation", kLapwing, 0.3},
    RatioTarget{"settled again, other weight", "settled preparation", kLapwing, 0.3},
    RatioTarget{"settled again, other Laplacians", "settled preparation", kLapwing, 0.3},
    RatioTarget{"drag frame", "settle iteration", kArap, 0.02},
    RatioTarget{"settle frame", "settle iteration", kArap, 1.0},
    RatioTarget{"settle frame in time", "settle iteration", kArap, 0.25},
};

void add_ratios(const Report& report, const std::string& device, std::vector<Target>& targets) {
  for (const RatioTarget& ratio : kRatios) {
    const Measurement* const ours = find(report, ratio.stage, kLapwing, device, kTargetMesh);
    const bool own = ratio.by == std::string(kLapwing);
    const Measurement* const other =
        find(report, ratio.beside, ratio.by, own ? device : kProcessor, kTargetMesh);
    if (ours == nullptr || other == nullptr) continue;
    targets.push_back({std::string(ratio.stage) + " / " + ratio.by + " " + ratio.beside,
                       std::string(kTargetMesh) + ", " + device, ratio.at_most, false,
                       median_of(ours->wall_ms) / median_of(other->wall_ms)});
  }
}

std::string subject_of(const Measurement& m) {
  return m.mesh + " (" + std::to_string(m.vertices) + "), " + m.device;
}

void add_large(const Report& report, std::vector<Target>& targets) {
  constexpr double kShareOfCopies = 0.6;
  constexpr double kFirstDrag_s = 15.0;
  constexpr double kMemory_gb = 16.0;
  double most_bytes = 0.0;
  for (const Measurement& m : report.measurements) {
    if (m.by != kLapwing) continue;
    if (m.stage == "drag frame" && m.vertices >= kLarge && limits_of(report, m) != nullptr) {
      targets.push_back({"drag frame, share of copy bandwidth", subject_of(m), kShareOfCopies, true,
                         share_of_limit(report, m)});
    }
    if (m.vertices < kMillion) continue;
    most_bytes = std::max(most_bytes, static_cast<double>(m.peak_bytes));
    if (m.stage == "first drag") {
      targets.push_back(
          {"first drag, seconds", subject_of(m), kFirstDrag_s, false, median_of(m.wall_ms) / 1e3});
    }
  }
  if (most_bytes > 0.0) {
    targets.push_back(
        {"peak memory, GB", "1,000,000 vertices", kMemory_gb, false, most_bytes / 1e9});
  }
}

}  // namespace

std::vector<Target> targets_of(const Report& report) {
  std::vector<Target> targets;
  for (const std::string& device : devices_of(report)) add_ratios(report, device, targets);
  add_large(report, targets);
  return targets;
}

}  // namespace lapwing::bench
