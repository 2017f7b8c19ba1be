#pragma once

#include <string>
#include <vector>

#include "report/report.h"

namespace lapwing::bench {

/// A row of ours on the processor about a scan of 26,002 vertices.
inline Measurement row(const std::string& stage, std::vector<double> wall_ms) {
  Measurement m;
  m.stage = stage;
  m.by = "Lapwing";
  m.device = "CPU";
  m.mesh = "armadillo";
  m.vertices = 26'002;
  m.wall_ms = std::move(wall_ms);
  return m;
}

inline Measurement row_by(const std::string& by, const std::string& stage,
                          std::vector<double> wall_ms) {
  Measurement m = row(stage, std::move(wall_ms));
  m.by = by;
  return m;
}

inline Report report_of(std::vector<Measurement> measurements) {
  Report report;
  report.date = "2023-05-06T07:08:09Z";
  report.commit = "0123abcd+";
  report.command = "lapwing-bench run --repeats 3";
  report.host = {"Some Processor 3 GHz", 2, 8'000'000'000, "Some System 1", "GCC 12.2.0"};
  report.limits = {{"CPU", "cpu", "", 10.0, 200.0, 100.0},
                   {"Some GPU", "discrete GPU", "driver 1.2", 400.0, 20'000.0, 500.0}};
  report.measurements = std::move(measurements);
  return report;
}

/// A little of everything: a stage with a peer, one with device times, counts and targets.
inline Report small_report() {
  Measurement factor = row("factor", {102.0, 100.0, 104.0});
  factor.cpu_ms = {200.0, 190.0, 210.0};
  factor.peak_bytes = 512'000'000;
  factor.counts = {{"flops", 4'000'000'000}, {"allocations", 12}};
  Measurement assemble = row("assemble", {4.0, 4.2, 4.1});
  assemble.device = "Some GPU";
  assemble.cpu_ms = {0.5, 0.6, 0.7};
  assemble.device_ms = {1.5, 1.25, 1.0};
  assemble.counts = {{"bytes", 250'000'000}};
  Report report = report_of({factor, row_by("CHOLMOD", "factor", {400.0, 404.0, 408.0}), assemble});
  report.targets = {{"factor / CHOLMOD", "armadillo, CPU", 0.5, false, 0.252},
                    {"frames a second", "armadillo, Some GPU", 60.0, true, 31.0}};
  return report;
}

}  // namespace lapwing::bench
