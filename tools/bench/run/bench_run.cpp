#include "run/bench_run.h"

#include <algorithm>
#include <cstdio>
#include <iterator>
#include <string>
#include <unistd.h>

#include "run/apart.h"
#include "run/stages.h"
#include "run/targets.h"

namespace lapwing::bench {
namespace {

// Shows a line that the next one replaces, if standard error is a terminal.
void show_progress(const std::string& text) {
  if (isatty(STDERR_FILENO) != 0) std::fprintf(stderr, "\r\033[K%s", text.c_str());
}

void forget_times(Measurement& measurement) {
  measurement.wall_ms.clear();
  measurement.cpu_ms.clear();
  measurement.device_ms.clear();
  measurement.peak_bytes = 0;
}

Report limits_of(const RunSettings& settings) {
  Report report;
  bool processor = false;
  for (const std::string& name : settings.devices) {
    const BenchDevice device = open_bench_device(name);
    report.limits.push_back(measure_limits(device));
    processor = processor || device.name == kProcessor;
  }
  if (!processor) report.limits.push_back(measure_limits(open_bench_device("cpu")));
  return report;
}

Report measure_subject(const RunSettings& settings, const SubjectSource& source) {
  BenchRun run(settings);
  const Subject subject = source.load();
  measure_mesh_stages(run, subject);
  measure_solver_stages(run, subject);
  measure_edit_stages(run, subject);
  measure_layer_stages(run, subject);
  measure_render(run, subject);
  measure_peers(run, subject);
  show_progress("");
  return std::move(run.report());
}

}  // namespace

BenchRun::BenchRun(const RunSettings& settings)
    : settings_(settings), processor_(open_bench_device("cpu")) {
  for (const std::string& name : settings.devices) devices_.push_back(open_bench_device(name));
}

bool BenchRun::wants(const std::string& stage, const std::string& by, const std::string& device,
                     const Subject& subject) const {
  if (by != kLapwing && !settings_.peers) return false;
  if (!settings_.filter) return true;
  return std::regex_search(stage + " / " + by + " / " + device + " / " + subject.name,
                           *settings_.filter);
}

Measurement* BenchRun::measure(const std::string& stage, const std::string& by,
                               const BenchDevice& device, const Subject& subject,
                               const std::function<void()>& work,
                               const std::function<void()>& before) {
  return measure(stage, by, device, subject, 0, work, before);
}

Measurement* BenchRun::measure(const std::string& stage, const std::string& by,
                               const BenchDevice& device, const Subject& subject, int least_runs,
                               const std::function<void()>& work,
                               const std::function<void()>& before) {
  last_kernels_.clear();
  if (!wants(stage, by, device.name, subject)) return nullptr;
  show_progress(subject.name + ", " + std::to_string(subject.vertices()) + " vertices: " + stage +
                " (" + by + ", " + device.name + ")");
  Measurement measurement;
  measurement.stage = stage;
  measurement.by = by;
  measurement.device = device.name;
  measurement.mesh = subject.name;
  measurement.vertices = subject.vertices();
  Meter meter(device.context.get());
  Repeats repeats = settings_.repeats;
  repeats.least = std::max(repeats.least, std::min(repeats.most, least_runs));
  if (settings_.only_counts) repeats = {1, 1, 0.0, 1};
  meter.run(measurement, repeats, work, before);
  last_kernels_ = meter.kernels();
  if (settings_.only_counts) forget_times(measurement);
  report_.measurements.push_back(std::move(measurement));
  return &report_.measurements.back();
}

Measurement* BenchRun::measure(const std::string& stage, const std::string& by,
                               const Subject& subject, const std::function<void()>& work,
                               const std::function<void()>& before) {
  return measure(stage, by, processor_, subject, work, before);
}

void BenchRun::add_kernel(const std::string& kernel, std::uint64_t bytes) {
  const auto found = last_kernels_.find(kernel);
  if (found == last_kernels_.end() || report_.measurements.empty()) return;
  Measurement row = report_.measurements.back();
  row.stage = "kernel " + kernel;
  row.wall_ms.clear();
  row.cpu_ms.clear();
  row.device_ms.clear();
  row.peak_bytes = 0;
  for (const gpu::KernelUse& use : found->second) row.device_ms.push_back(use.device_ms);
  if (settings_.only_counts) forget_times(row);
  const std::uint64_t dispatches = found->second.back().dispatches;
  row.counts = {{"dispatches", dispatches}, {"bytes", bytes}};
  report_.measurements.push_back(std::move(row));
}

void BenchRun::leave_out(const std::string& what, const Subject& subject, const std::string& why) {
  show_progress("");
  std::fprintf(stderr, "%s, %zu vertices: %s is left out: %s\n", subject.name.c_str(),
               subject.vertices(), what.c_str(), why.c_str());
}

Report run_benchmark(const RunSettings& settings,
                     const std::function<void(const Report&)>& after_mesh) {
  Report report;
  if (settings.limits)
    report.limits = report_from_child_process([&] { return limits_of(settings); }).limits;
  for (const SubjectSource& source : all_subjects(settings.models)) {
    if (source.vertices > settings.most_vertices || source.vertices < settings.least_vertices) {
      continue;
    }
    Report one = report_from_child_process([&] { return measure_subject(settings, source); });
    std::move(one.measurements.begin(), one.measurements.end(),
              std::back_inserter(report.measurements));
    report.targets = targets_of(report);
    if (after_mesh) after_mesh(report);
  }
  return report;
}

}  // namespace lapwing::bench
