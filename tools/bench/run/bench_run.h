#pragma once

#include <functional>
#include <optional>
#include <regex>
#include <string>
#include <vector>

#include "report/report.h"
#include "run/bench_device.h"
#include "run/meter.h"
#include "run/subject.h"

namespace lapwing::bench {

/// What is measured, on what, and how often.
struct RunSettings {
  std::string models = "build/models";  ///< where the scans are
  std::vector<std::string> devices{"cpu", "auto"};
  std::size_t most_vertices = 1'100'000;  ///< larger meshes are left out
  std::size_t least_vertices = 0;         ///< smaller ones too
  /// Only rows in which "stage / who / device / mesh" has a match; all without.
  std::optional<std::regex> filter;
  bool peers = true;  ///< CGAL, Eigen and CHOLMOD too, where they were there to build with
  std::size_t most_for_eigen = 30'000;  ///< vertices that Eigen factors; minutes beyond
  bool limits = true;
  Repeats repeats;
  /// What one piece of work may take; what would need more is left out, and said so.
  std::uint64_t memory_bytes = 0;
  bool only_counts = false;  ///< one run of everything, for what it counts
};

inline constexpr const char* kLapwing = "Lapwing";
inline constexpr const char* kProcessor = "CPU";

/// A run of the benchmark: what measures, and where the results go.
class BenchRun {
 public:
  explicit BenchRun(const RunSettings& settings);

  const RunSettings& settings() const { return settings_; }
  const std::vector<BenchDevice>& devices() const { return devices_; }
  Report& report() { return report_; }

  /// Whether a row is asked for; what only serves rows that are not need not be made ready.
  bool wants(const std::string& stage, const std::string& by, const std::string& device,
             const Subject& subject) const;

  /// Measures `work`, unless the row is not wanted: then null. The row stays the report's until the
  /// next one; add to its counts.
  Measurement* measure(const std::string& stage, const std::string& by, const BenchDevice& device,
                       const Subject& subject, const std::function<void()>& work,
                       const std::function<void()>& before = {});
  /// With at least so many runs if the settings allow as many, and none takes kLongRun_ms.
  Measurement* measure(const std::string& stage, const std::string& by, const BenchDevice& device,
                       const Subject& subject, int least_runs, const std::function<void()>& work,
                       const std::function<void()>& before = {});
  /// On the processor, whatever the device.
  Measurement* measure(const std::string& stage, const std::string& by, const Subject& subject,
                       const std::function<void()>& work, const std::function<void()>& before = {});

  /// Rows "kernel NAME" of what the last `measure` ran on its device; `bytes` is what each dispatch
  /// must move at least.
  void add_kernel(const std::string& kernel, std::uint64_t bytes);

  /// Says on the terminal why something is left out.
  void leave_out(const std::string& what, const Subject& subject, const std::string& why);

 private:
  RunSettings settings_;
  BenchDevice processor_;
  std::vector<BenchDevice> devices_;
  Report report_;
  std::map<std::string, std::vector<gpu::KernelUse>> last_kernels_;
};

/// Measures everything the settings ask for, each mesh in a process of its own (see made_apart).
/// Says on the error stream what is under way, and hands what there is so far to `after_mesh` after
/// each.
Report run_benchmark(const RunSettings& settings,
                     const std::function<void(const Report&)>& after_mesh = {});

}  // namespace lapwing::bench
