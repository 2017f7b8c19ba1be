#include "run/bench_run.h"

#include <algorithm>
#include <cstdio>
#include <iterator>
#include <string>
#include <unistd.h>

#include "report/targets.h"
#include "run/apart.h"

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
  BenchRun run(settings, source.load());
  measure_mesh_stages(run);
  measure_solver_stages(run);
  measure_edit_stages(run);
  measure_layer_stages(run);
  measure_render(run);
  measure_peers(run);
  show_progress("");
  return std::move(run.report());
}

}  // namespace

BenchRun::BenchRun(const RunSettings& settings, Subject subject)
    : settings_(settings), subject_(std::move(subject)), processor_(open_bench_device("cpu")) {
  for (const std::string& name : settings.devices) devices_.push_back(open_bench_device(name));
}

bool BenchRun::wants(const std::string& stage, const std::string& by,
                     const std::string& device) const {
  return !settings_.filter ||
         std::regex_search(stage + " / " + by + " / " + device + " / " + subject_.name,
                           *settings_.filter);
}

bool BenchRun::wants(const std::string& stage, const BenchDevice& device) const {
  return wants(stage, kLapwing, device.name);
}

bool BenchRun::wants_peer(const std::string& stage, const std::string& by) const {
  return settings_.peers && wants(stage, by, kProcessor);
}

Measurement* BenchRun::measure(const std::string& stage, const BenchDevice& device,
                               const std::function<void()>& work,
                               const std::function<void()>& before, int least_runs) {
  last_kernels_.clear();
  if (!wants(stage, device)) return nullptr;
  return add_row(stage, kLapwing, device, work, before, least_runs);
}

Measurement* BenchRun::measure(const std::string& stage, const std::function<void()>& work,
                               const std::function<void()>& before) {
  return measure(stage, processor_, work, before);
}

Measurement* BenchRun::measure_peer(const std::string& stage, const std::string& by,
                                    const std::function<void()>& work,
                                    const std::function<void()>& before) {
  if (!wants_peer(stage, by)) return nullptr;
  return add_row(stage, by, processor_, work, before, 0);
}

Measurement* BenchRun::add_row(const std::string& stage, const std::string& by,
                               const BenchDevice& device, const std::function<void()>& work,
                               const std::function<void()>& before, int least_runs) {
  show_progress(subject_.name + ", " + std::to_string(subject_.vertices()) + " vertices: " + stage +
                " (" + by + ", " + device.name + ")");
  Measurement row;
  row.stage = stage;
  row.by = by;
  row.device = device.name;
  row.mesh = subject_.name;
  row.vertices = subject_.vertices();
  Meter meter(device.context.get());
  Repeats repeats = settings_.repeats;
  repeats.least = std::max(repeats.least, std::min(repeats.most, least_runs));
  if (settings_.only_counts) repeats = {1, 1, 0.0, 1};
  meter.run(row, repeats, work, before);
  last_kernels_ = meter.kernels();
  if (settings_.only_counts) forget_times(row);
  report_.measurements.push_back(std::move(row));
  return &report_.measurements.back();
}

void BenchRun::add_kernel(const std::string& kernel, std::uint64_t bytes) {
  const auto found = last_kernels_.find(kernel);
  if (found == last_kernels_.end() || report_.measurements.empty()) return;
  Measurement row = report_.measurements.back();
  row.stage = "kernel " + kernel;
  forget_times(row);
  if (!settings_.only_counts) {
    for (const gpu::KernelUse& use : found->second) row.device_ms.push_back(use.device_ms);
  }
  const std::uint64_t dispatches = found->second.back().dispatches;
  row.counts = {{"dispatches", dispatches}, {"bytes", bytes}};
  report_.measurements.push_back(std::move(row));
}

void BenchRun::leave_out(const std::string& what, const std::string& why) const {
  show_progress("");
  std::fprintf(stderr, "%s, %zu vertices: %s is left out: %s\n", subject_.name.c_str(),
               subject_.vertices(), what.c_str(), why.c_str());
}

namespace {

void note_missing_scans(const RunSettings& settings) {
  std::string names;
  for (const std::string& name :
       missing_scans(settings.models, settings.least_vertices, settings.most_vertices)) {
    names += (names.empty() ? "" : ", ") + name;
  }
  if (names.empty()) return;
  const std::string& models = settings.models;
  std::fprintf(stderr,
               "lapwing-bench: note: left out, because %s does not have them: %s. "
               "`tools/setup/fetch-models %s` fetches them; --models names another folder\n",
               models.c_str(), names.c_str(), models.c_str());
}

}  // namespace

Report run_benchmark(const RunSettings& settings,
                     const std::function<void(const Report&)>& after_mesh) {
  note_missing_scans(settings);
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
