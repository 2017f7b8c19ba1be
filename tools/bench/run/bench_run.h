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

/// The settings of a benchmark run.
struct RunSettings {
  std::string models = "build/models";  ///< folder of the scans
  std::vector<std::string> devices{"cpu", "auto"};
  std::size_t most_vertices = 1'100'000;  ///< larger meshes are left out
  std::size_t least_vertices = 0;         ///< smaller ones too
  /// Measures only rows whose "stage / who / device / mesh" matches; all rows if not set.
  std::optional<std::regex> filter;
  bool peers = true;  ///< also measures CGAL, Eigen and CHOLMOD, if built with them
  std::size_t most_for_eigen = 30'000;  ///< largest mesh for Eigen's factorization; minutes beyond
  bool limits = true;
  Repeats repeats;
  /// Memory limit of one stage. A stage that needs more is left out, with a message.
  std::uint64_t memory_bytes = 0;
  bool only_counts = false;  ///< runs everything once and keeps only the counts
};

inline constexpr const char* kLapwing = "Lapwing";
inline constexpr const char* kProcessor = "CPU";

/// A run of the benchmark: measures work and collects the rows of the report.
class BenchRun {
 public:
  explicit BenchRun(const RunSettings& settings);

  const RunSettings& settings() const { return settings_; }
  const std::vector<BenchDevice>& devices() const { return devices_; }
  Report& report() { return report_; }

  /// Returns whether a row is asked for. Skip preparations that only unwanted rows need.
  bool wants(const std::string& stage, const std::string& by, const std::string& device,
             const Subject& subject) const;

  /// Measures `work` and adds a row to the report. Returns null if the row is not wanted. The
  /// pointer is valid until the next row; add further counts to it.
  Measurement* measure(const std::string& stage, const std::string& by, const BenchDevice& device,
                       const Subject& subject, const std::function<void()>& work,
                       const std::function<void()>& before = {});
  /// The same with at least `least_runs` runs, if the settings allow them and a run is shorter than
  /// kLongRun_ms.
  Measurement* measure(const std::string& stage, const std::string& by, const BenchDevice& device,
                       const Subject& subject, int least_runs, const std::function<void()>& work,
                       const std::function<void()>& before = {});
  /// The same on the processor.
  Measurement* measure(const std::string& stage, const std::string& by, const Subject& subject,
                       const std::function<void()>& work, const std::function<void()>& before = {});

  /// Adds a row "kernel NAME" for a kernel that the last `measure` ran on its device. `bytes` is
  /// the least that a dispatch must move.
  void add_kernel(const std::string& kernel, std::uint64_t bytes);

  /// Prints to standard error why something is left out.
  void leave_out(const std::string& what, const Subject& subject, const std::string& why);

 private:
  RunSettings settings_;
  BenchDevice processor_;
  std::vector<BenchDevice> devices_;
  Report report_;
  std::map<std::string, std::vector<gpu::KernelUse>> last_kernels_;
};

/// Measures everything that the settings ask for, each mesh in a separate process
/// (report_from_child_process). Prints progress to standard error. Calls `after_mesh` with the
/// report so far after each mesh.
Report run_benchmark(const RunSettings& settings,
                     const std::function<void(const Report&)>& after_mesh = {});

}  // namespace lapwing::bench
