#include "run_command.h"

#include <cstdio>
#include <optional>
#include <regex>
#include <sched.h>

#include <CLI/CLI.hpp>

#include "lapwing/base/errors.h"
#include "report/report_json.h"
#include "report/table.h"
#include "report/text_file.h"
#include "run/bench_run.h"
#include "run/host.h"
#include "run/targets.h"

namespace lapwing::bench {
namespace {

// A quick run takes a minute on two cores, peers included.
constexpr std::size_t kQuickMost = 30'000;
constexpr std::size_t kQuickLeast = 9'900;
constexpr std::size_t kQuickMostForEigen = 9'900;
constexpr Repeats kQuick{3, 21, 100.0, 3};

std::optional<std::regex> as_regex(const std::string& text) {
  if (text.empty()) return std::nullopt;
  try {
    return std::regex(text, std::regex::ECMAScript | std::regex::icase);
  } catch (const std::regex_error& error) {
    throw InputError("--filter: '" + text + "' is no regular expression (" + error.what() + ")");
  }
}

// Keeps the process on one processor, so that counts do not depend on the machine's threads.
void use_one_processor() {
  cpu_set_t allowed;
  CPU_ZERO(&allowed);
  if (sched_getaffinity(0, sizeof allowed, &allowed) != 0) return;
  for (std::size_t p = 0; p < CPU_SETSIZE; ++p) {
    if (!CPU_ISSET(p, &allowed)) continue;
    CPU_ZERO(&allowed);
    CPU_SET(p, &allowed);
    sched_setaffinity(0, sizeof allowed, &allowed);
    return;
  }
}

}  // namespace

RunCommand::RunCommand(CLI::App& app) {
  app.add_flag("--quick", quick_, "meshes of 10,000 to 30,000 vertices and fewer runs: a minute");
  app.add_option("--filter", filter_,
                 "only rows \"stage / who / device / mesh\" that this regular expression finds");
  app.add_option("--devices", devices_, "cpu, auto, an index or a part of a name, by commas")
      ->delimiter(',')
      ->capture_default_str();
  app.add_option("--vertices", vertices_, "least and most vertices of the meshes, by a comma")
      ->delimiter(',')
      ->expected(2);
  app.add_option("--repeats", repeats_, "counted runs of each thing at least (5)")
      ->check(CLI::Range(1, 1000));
  app.add_option("--models", models_, "where tools/setup/fetch-models put the scans")
      ->capture_default_str();
  app.add_option("--memory", memory_gb_, "GB that a factorization may take")
      ->check(CLI::Range(0.1, 1e4))
      ->capture_default_str();
  app.add_flag("--no-peers", no_peers_, "neither CGAL nor Eigen nor CHOLMOD");
  auto* json = app.add_option("--json", json_, "write the report here");
  app.add_flag("--counts", counts_,
               "only what does not vary (allocations, dispatches, bytes, operations, nonzeros)")
      ->needs(json);
  app.add_option("--show", show_,
                 "print a report, by today's targets; --json writes it again: nothing is measured");
}

void RunCommand::run(const std::string& command_line) const {
  if (!show_.empty()) {
    Report report = read_report(show_);
    report.targets = targets_of(report);
    std::fputs(table_of(report).c_str(), stdout);
    if (!json_.empty()) write_text(json_, to_json(report));
    return;
  }
  RunSettings settings;
  settings.models = models_;
  settings.devices = devices_;
  settings.filter = as_regex(filter_);
  settings.peers = !no_peers_ && !counts_;
  settings.limits = !counts_;
  settings.only_counts = counts_;
  if (counts_) use_one_processor();
  settings.memory_bytes = static_cast<std::uint64_t>(memory_gb_ * 1e9);
  if (quick_) {
    settings.least_vertices = kQuickLeast;
    settings.most_vertices = kQuickMost;
    settings.repeats = kQuick;
    settings.most_for_eigen = kQuickMostForEigen;
  }
  if (!vertices_.empty()) {
    settings.least_vertices = vertices_[0];
    settings.most_vertices = vertices_[1];
  }
  if (repeats_ > 0) {
    settings.repeats.least = repeats_;
    settings.repeats.most = std::max(settings.repeats.most, repeats_);
  }
  // Check first: a typing error in the path must not cost minutes of measuring.
  if (!json_.empty()) require_writable(json_);
  const auto sign = [&command_line](Report& report) {
    report.date = now_utc();
    report.commit = built_from();
    report.command = command_line;
    report.host = this_host();
  };
  // Write after each mesh, so that a failure does not lose half an hour of measuring.
  Report report = run_benchmark(settings, [&](Report so_far) {
    if (json_.empty() || so_far.measurements.empty()) return;
    sign(so_far);
    write_text(json_, to_json(so_far));
  });
  if (report.measurements.empty()) {
    throw InputError("nothing was measured: no row matches --filter and --vertices");
  }
  sign(report);
  if (!counts_) std::fputs(table_of(report).c_str(), stdout);
  if (!json_.empty()) write_text(json_, to_json(report));
}

}  // namespace lapwing::bench
