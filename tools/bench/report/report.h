#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

namespace lapwing::bench {

/// What does not vary from run to run nor, but for the last bits of an ordering, from machine to
/// machine: "allocations", "dispatches", "submissions", "uploaded" and "downloaded" (bytes between
/// host and device), "bytes" (those that the work must move at least, reads and writes), "flops",
/// "nonzeros" (of a factor's lower triangle), "iterations".
using Counts = std::map<std::string, std::uint64_t>;

/// One piece of work, done several times.
struct Measurement {
  std::string stage;   ///< "assemble", "drag frame"
  std::string by;      ///< who did it: "Lapwing", "CGAL ARAP", "Eigen", "CHOLMOD"
  std::string device;  ///< on what: a Limits::device of the report
  std::string mesh;    ///< "armadillo", "sphere"
  std::size_t vertices = 0;
  std::vector<double> wall_ms;    ///< one number per counted run, in the order of the runs
  std::vector<double> cpu_ms;     ///< processor time of all threads, likewise
  std::vector<double> device_ms;  ///< by the device's own timestamps, likewise; or empty
  std::uint64_t peak_bytes = 0;   ///< largest resident size of the process meanwhile; 0: unknown
  Counts counts;
};

/// What a device can do at best, measured in the same run.
struct Limits {
  std::string device;  ///< "llvmpipe (LLVM 15.0.6, 256 bits)", "CPU"
  std::string type;    ///< "discrete GPU", "integrated GPU", "virtual GPU", "software", "cpu"
  std::string driver;  ///< name and version; empty for the processor
  /// Bytes read plus bytes written in a copy from one large buffer to another, 1e9 a second.
  double copy_gb_per_s = 0;
  double matmul_gflops_float32 = 0;  ///< product of large matrices, 1e9 operations a second
  double matmul_gflops_float64 = 0;  ///< likewise; 0 where the device has none
};

/// Where a report was made.
struct Host {
  std::string processor;  ///< as the system names it
  unsigned threads = 0;   ///< that the process may run on
  std::uint64_t memory_bytes = 0;
  std::string system;    ///< name of the operating system
  std::string compiler;  ///< that built the benchmark, with its version
};

/// What was asked for, as a bound from above, beside what this run gave.
struct Target {
  std::string name;    ///< "whole preparation / CGAL ARAP preprocess"
  std::string on;      ///< the mesh and device that it is about
  double at_most = 0;  ///< or at least, if `is_floor`
  bool is_floor = false;
  double measured = 0;
  bool met() const { return is_floor ? measured >= at_most : measured <= at_most; }
};

/// One run of the benchmark.
struct Report {
  std::string date;    ///< ISO 8601, UTC
  std::string commit;  ///< of the source that the benchmark was built from; "+" appended if changed
  std::string command;
  Host host;
  std::vector<Limits> limits;
  std::vector<Measurement> measurements;
  std::vector<Target> targets;
};

/// Median and quartiles (by linear interpolation) of some numbers.
struct Spread {
  double median = 0;
  double low = 0;   ///< the lower quartile
  double high = 0;  ///< the upper quartile
};

/// All 0 for no numbers.
Spread spread_of(std::vector<double> numbers);

/// The limits of a measurement's device; null where they were not measured.
const Limits* limits_of(const Report& report, const Measurement& measurement);

/// What share of its limit the work reaches by its median wall time, or device time where only that
/// is known (kernels): "flops" over the rate of float64 products, or "bytes" over the copy rate,
/// whichever share is larger. 0 where neither is counted or no limit is known.
double share_of_limit(const Report& report, const Measurement& measurement);

}  // namespace lapwing::bench
