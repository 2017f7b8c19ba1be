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

/// Measures work on one mesh and collects the rows of the report. A row without the name of a peer
/// is a measurement of Lapwing.
class BenchRun {
 public:
  BenchRun(const RunSettings& settings, Subject subject);

  const RunSettings& settings() const { return settings_; }
  const Subject& subject() const { return subject_; }
  const std::vector<BenchDevice>& devices() const { return devices_; }
  const BenchDevice& processor() const { return processor_; }
  Report& report() { return report_; }

  /// Returns whether a row is asked for. Skip preparations that only unwanted rows need.
  bool wants(const std::string& stage, const BenchDevice& device) const;
  bool wants_peer(const std::string& stage, const std::string& by) const;

  /// Measures `work` and adds a row to the report. Calls `before` before every run, outside the
  /// measured time. Runs at least `least_runs` times if the settings allow it and a run is shorter
  /// than kLongRun_ms. Returns the row, or null if the filter excludes it. The caller may add
  /// counts to the row until the next row is measured.
  Measurement* measure(const std::string& stage, const BenchDevice& device,
                       const std::function<void()>& work, const std::function<void()>& before = {},
                       int least_runs = 0);
  /// The first function measures work of Lapwing on the CPU, the second that of a peer.
  Measurement* measure(const std::string& stage, const std::function<void()>& work,
                       const std::function<void()>& before = {});
  Measurement* measure_peer(const std::string& stage, const std::string& by,
                            const std::function<void()>& work,
                            const std::function<void()>& before = {});

  /// Adds a row "kernel NAME" for a kernel that the last `measure` ran on its device. `bytes` is
  /// the least that a dispatch must move.
  void add_kernel(const std::string& kernel, std::uint64_t bytes);

  /// Prints to standard error why something is left out.
  void leave_out(const std::string& what, const std::string& why) const;

 private:
  bool wants(const std::string& stage, const std::string& by, const std::string& device) const;
  Measurement* add_row(const std::string& stage, const std::string& by, const BenchDevice& device,
                       const std::function<void()>& work, const std::function<void()>& before,
                       int least_runs);

  RunSettings settings_;
  Subject subject_;
  BenchDevice processor_;
  std::vector<BenchDevice> devices_;
  Report report_;
  std::map<std::string, std::vector<gpu::KernelUse>> last_kernels_;
};

// Each group of rows is in the file of the same name, stages_*.cpp or peers.cpp.

/// Measures "read OBJ", "read PLY", "check" and "topology" on the CPU.
void measure_mesh_stages(BenchRun& run);

/// Measures each stage of a preparation alone: "pattern", "order", "laplacian weights", "assemble"
/// (on every device), "normal matrix", "analyze", "factor", "response" (twelve columns),
/// "back-substitution" (one), and "laplacian" for the n x n system.
void measure_solver_stages(BenchRun& run);

/// Measures what a user waits for, on every device: "first drag", "preparation", "again, other
/// handle" and so on, "drag frame", "shader frame", "settle iteration", "settle frame".
void measure_edit_stages(BenchRun& run);

/// Measures "coat", "mix" and "transplant" of a ninth of the mesh, on every device, for sheets of
/// hills.
void measure_layer_stages(BenchRun& run);

/// Measures "show mesh" and "render", an image of 1280 x 800 pixels, on every device that draws.
void measure_render(BenchRun& run);

/// Measures the same work by others: CGAL's ARAP ("preparation", "settle iteration", "settle
/// frame"), the factorizations of Eigen and CHOLMOD ("analyze", "factor", "response"), and Eigen's
/// sparse product ("normal matrix"). Leaves out libraries that the benchmark was built without.
void measure_peers(BenchRun& run);

/// Measures everything that the settings ask for, each mesh in a separate process
/// (report_from_child_process). Prints progress to standard error. Calls `after_mesh` with the
/// report so far after each mesh.
Report run_benchmark(const RunSettings& settings,
                     const std::function<void(const Report&)>& after_mesh = {});

}  // namespace lapwing::bench
