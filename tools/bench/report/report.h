#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace lapwing::bench {

/// The value of Measurement::by in our rows. All other rows are peers'.
inline constexpr const char* kLapwing = "Lapwing";
/// Measurement::device has this value for work on the CPU.
inline constexpr const char* kProcessor = "CPU";
/// The mesh to which most targets apply.
inline constexpr const char* kTargetMesh = "armadillo";

/// Counts by name. They are the same in every run and, up to the last bits of an ordering, on every
/// machine: "allocations", "dispatches", "submissions", "uploaded" and "downloaded" (bytes between
/// host and device), "bytes" (the least that the work must read and write), "flops", "nonzeros" (of
/// a factor's lower triangle), "iterations".
using Counts = std::map<std::string, std::uint64_t>;

/// Measurements of one piece of work, which ran several times.
struct Measurement {
  std::string stage;   ///< "assemble", "drag frame"
  std::string by;      ///< implementation: "Lapwing", "CGAL ARAP", "Eigen", "CHOLMOD"
  std::string device;  ///< as in Limits::device
  std::string mesh;    ///< "armadillo", "sphere"
  std::size_t vertices = 0;
  std::vector<double> wall_ms;    ///< one number per counted run, in the order of the runs
  std::vector<double> cpu_ms;     ///< CPU time of all threads, likewise
  std::vector<double> device_ms;  ///< from the device's timestamps, likewise; may be empty
  std::uint64_t peak_bytes = 0;   ///< largest resident size of the process; 0 if unknown
  Counts counts;

  bool is_ours() const { return by == kLapwing; }
  /// Returns the wall times or, if there are none, the device times (rows of kernels).
  const std::vector<double>& clock_ms() const { return wall_ms.empty() ? device_ms : wall_ms; }
};

/// The peak rates of a device, measured in the same run.
struct Limits {
  std::string device;  ///< "llvmpipe (LLVM 15.0.6, 256 bits)", "CPU"
  std::string type;    ///< "discrete GPU", "integrated GPU", "virtual GPU", "software", "cpu"
  std::string driver;  ///< name and version; empty for the CPU
  /// Bytes read plus bytes written in a copy between two large buffers, 1e9 per second.
  double copy_gb_per_s = 0;
  double matmul_gflops_float32 = 0;  ///< product of large matrices, 1e9 operations per second
  double matmul_gflops_float64 = 0;  ///< likewise; 0 if the device has no float64
};

struct Host {
  std::string processor;
  unsigned threads = 0;  ///< number of threads that the process may use
  std::uint64_t memory_bytes = 0;
  std::string system;    ///< name of the operating system
  std::string compiler;  ///< name and version
};

/// A required bound and the value that this run measured.
struct Target {
  std::string name;    ///< for example "first drag / CGAL ARAP preparation"
  std::string on;      ///< mesh and device, for example "armadillo, CPU"
  double at_most = 0;  ///< the bound; a lower bound if `is_floor`
  bool is_floor = false;
  double measured = 0;

  bool met() const { return is_floor ? measured >= at_most : measured <= at_most; }
};

/// One run of the benchmark.
struct Report {
  std::string date;    ///< ISO 8601, UTC
  std::string commit;  ///< source revision of the build; ends in "+" if it was modified
  std::string command;
  Host host;
  std::vector<Limits> limits;
  std::vector<Measurement> measurements;
  std::vector<Target> targets;
};

/// Median and quartiles, interpolated linearly.
struct Spread {
  double median = 0;
  double low = 0;   ///< the lower quartile
  double high = 0;  ///< the upper quartile
};

/// Returns zeros for an empty list.
Spread spread_of(std::vector<double> numbers);

inline double median_of(const std::vector<double>& numbers) {
  return spread_of(numbers).median;
}

/// Returns whether both rows are about the same mesh at the same size.
bool same_subject(const Measurement& a, const Measurement& b);

/// Returns the peers' rows of the same stage and mesh, on any device; none if `ours` is a peer's
/// row.
std::vector<const Measurement*> peers_of(const Report& report, const Measurement& ours);

/// Returns one row for each mesh and size, in the order of the report.
std::vector<const Measurement*> subjects_of(const Report& report);

/// Returns the devices of all rows, in the order of the report.
std::vector<std::string> devices_of(const Report& report);

/// Returns the limits of the measurement's device, or null if they were not measured.
const Limits* limits_of(const Report& report, const Measurement& measurement);

/// Returns the fraction of the device's peak rate that the work reaches. The minimal time of the
/// work is the larger of two times: "flops" divided by the float64 multiplication rate, and "bytes"
/// divided by the copy rate. The result is this time divided by the median of `clock_ms`. Returns 0
/// if nothing was counted or no peak rate is known.
double share_of_limit(const Report& report, const Measurement& measurement);

}  // namespace lapwing::bench
