#include <algorithm>
#include <cstdio>
#include <exception>
#include <optional>
#include <regex>
#include <sched.h>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>

#include "lapwing/base/errors.h"
#include "lapwing/io/atomic_file.h"
#include "report/report_json.h"
#include "report/table.h"
#include "report/targets.h"
#include "run/bench_run.h"
#include "run/host.h"
#include "studies/studies.h"

namespace {

using namespace lapwing;
using namespace lapwing::bench;

// Options of the benchmark without a subcommand.
struct RunOptions {
  bool quick = false;
  bool counts = false;
  bool no_peers = false;
  bool all_columns = false;
  std::string filter;
  std::string models = "build/models";
  std::vector<std::string> devices{"cpu", "auto"};
  std::vector<std::size_t> vertices;  // minimum and maximum, or empty
  int repeats = 0;
  double memory_gb = 16.0;
  std::string json;
  std::string show;
};

// Adds the options of the benchmark to `app`. Parsing writes their values to `options`, which must
// outlive `app`.
void add_run(CLI::App& app, RunOptions& options) {
  app.add_flag("--quick", options.quick,
               "meshes of 10,000 to 30,000 vertices and fewer runs: a minute");
  app.add_option("--filter", options.filter,
                 "only rows \"stage / who / device / mesh\" that this regular expression finds");
  app.add_option("--devices", options.devices, "cpu, auto, an index or a part of a name, by commas")
      ->delimiter(',')
      ->capture_default_str();
  app.add_option("--vertices", options.vertices,
                 "least and most vertices of the meshes, by a comma")
      ->delimiter(',')
      ->expected(2);
  app.add_option("--repeats", options.repeats, "counted runs of each thing at least (5)")
      ->check(CLI::Range(1, 1000));
  app.add_option("--models", options.models, "where tools/setup/fetch-models put the scans")
      ->capture_default_str();
  app.add_option("--memory", options.memory_gb, "GB that a factorization may take")
      ->check(CLI::Range(0.1, 1e4))
      ->capture_default_str();
  app.add_flag("--no-peers", options.no_peers, "neither CGAL nor Eigen nor CHOLMOD");
  app.add_flag("--all-columns", options.all_columns,
               "print all meshes, numbers and targets, not one screen");
  auto* json = app.add_option("--json", options.json, "write the report here");
  app.add_flag("--counts", options.counts,
               "only what does not vary (allocations, dispatches, bytes, operations, nonzeros)")
      ->needs(json);
  app.add_option("--show", options.show,
                 "print a report, by today's targets; --json writes it again: nothing is measured");
}

std::optional<std::regex> as_regex(const std::string& text) {
  if (text.empty()) return std::nullopt;
  try {
    return std::regex(text, std::regex::ECMAScript | std::regex::icase);
  } catch (const std::regex_error& error) {
    throw InputError("--filter: '" + text + "' is no regular expression (" + error.what() + ")");
  }
}

RunSettings settings_of(const RunOptions& options) {
  // A quick run takes a minute on two cores, peers included.
  constexpr std::size_t kQuickMost = 30'000;
  constexpr std::size_t kQuickLeast = 9'900;
  constexpr Repeats kQuick{3, 21, 100.0, 3};
  RunSettings settings;
  settings.models = options.models;
  settings.devices = options.devices;
  settings.filter = as_regex(options.filter);
  settings.peers = !options.no_peers && !options.counts;
  settings.limits = !options.counts;
  settings.only_counts = options.counts;
  settings.memory_bytes = static_cast<std::uint64_t>(options.memory_gb * 1e9);
  if (options.quick) {
    settings.least_vertices = kQuickLeast;
    settings.most_vertices = kQuickMost;
    settings.repeats = kQuick;
    settings.most_for_eigen = kQuickLeast;
  }
  if (!options.vertices.empty()) {
    settings.least_vertices = options.vertices[0];
    settings.most_vertices = options.vertices[1];
  }
  if (options.repeats > 0) {
    settings.repeats.least = options.repeats;
    settings.repeats.most = std::max(settings.repeats.most, options.repeats);
  }
  return settings;
}

// Restricts the process to one CPU core, so that counts do not depend on the number of threads.
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

void print(const RunOptions& options, const Report& report) {
  std::fputs((options.all_columns ? table_of(report) : screen_of(report)).c_str(), stdout);
}

void show(const RunOptions& options) {
  Report report = read_report(options.show);
  report.targets = targets_of(report);
  print(options, report);
  if (!options.json.empty()) replace_file(options.json, to_json(report));
}

void run(const RunOptions& options, const std::string& command_line) {
  if (options.counts) use_one_processor();
  const RunSettings settings = settings_of(options);
  // Check first: a typing error in the path must not cost minutes of measuring.
  if (!options.json.empty()) require_replaceable(options.json);
  // Write after each mesh, so that a failure does not lose half an hour of measuring.
  const auto signed_and_written = [&](Report report) {
    report.date = now_utc();
    report.commit = built_from();
    report.command = command_line;
    report.host = this_host();
    if (!options.json.empty()) replace_file(options.json, to_json(report));
    return report;
  };
  const Report report = run_benchmark(settings, [&](const Report& so_far) {
    if (!so_far.measurements.empty()) signed_and_written(so_far);
  });
  if (report.measurements.empty()) {
    throw InputError("nothing was measured: no row matches --filter and --vertices");
  }
  const Report whole = signed_and_written(report);
  if (!options.counts) print(options, whole);
}

// The options of the studies: subcommands that measure one thing in detail.
struct Studies {
  RealBench real;
  ConstraintsBench constraints;
  FollowBench follow;
  FrameBench frame;
};

// Adds the subcommands. Parsing writes to `studies`, which must outlive it.
void add_studies(CLI::App& app, Studies& studies) {
  auto* real = app.add_subcommand(
      "real", "two edits of every real mesh, settled and linear, beside ARAP and Smooth ARAP");
  real->add_option("PATH", studies.real.paths, "mesh files, and folders to search for them")
      ->capture_default_str();
  real->add_option("--only", studies.real.only, "only meshes with this in their names");
  real->add_option("--most-vertices", studies.real.most_vertices, "pass over larger meshes");
  real->add_option("--arap-iterations", studies.real.arap_iterations,
                   "of ARAP and Smooth ARAP, at most")
      ->check(CLI::Range(1, 1'000'000))
      ->capture_default_str();
  real->add_option("--seconds", studies.real.seconds, "that a mesh may take")
      ->check(CLI::Range(1.0, 1e6))
      ->capture_default_str();
  real->add_option("--show", studies.real.show, "what --json wrote: nothing is measured");
  real->add_option("--json", studies.real.json, "write all runs and the summary here");
  real->callback([&] { bench_real(studies.real); });

  auto* follow = app.add_subcommand(
      "follow", "drags settled frame by frame in a given time, and how far they are from settled");
  follow->add_option("MESH", studies.follow.meshes)->required();
  follow->add_option("--subdivide", studies.follow.subdivisions, "so many times")
      ->check(CLI::Range(0, 4));
  follow->add_option("--device", studies.follow.device,
                     "compares this device's frames with their CPU twin");
  follow->add_option("--budget", studies.follow.budget_ms, "milliseconds of a frame")
      ->check(CLI::PositiveNumber);
  follow->callback([&] { bench_follow(studies.follow); });

  auto* constraints =
      app.add_subcommand("constraints", "what many handles and landmarks cost beside one handle");
  constraints->add_option("MESH", studies.constraints.mesh)->required();
  constraints->add_option("--subdivide", studies.constraints.subdivisions, "so many times")
      ->check(CLI::Range(0, 5));
  constraints->add_option("--handles", studies.constraints.handles)->check(CLI::PositiveNumber);
  constraints->add_option("--landmarks", studies.constraints.landmarks)->check(CLI::PositiveNumber);
  constraints->callback([&] { bench_constraints(studies.constraints); });

#ifdef LAPWING_HAVE_VIEWER
  auto* frame = app.add_subcommand("frame", "what a frame of the viewer costs, by parts");
  frame->add_option("MESH", studies.frame.mesh)->required();
  frame
      ->add_option("--repeats", studies.frame.repeats,
                   "counted runs of each thing, after one to warm up")
      ->check(CLI::Range(1, 1000))
      ->capture_default_str();
  frame->add_option("--device", studies.frame.device);
  frame->add_option("--width", studies.frame.width)->capture_default_str();
  frame->add_option("--height", studies.frame.height)->capture_default_str();
  frame->callback([&] { bench_frame(studies.frame); });
#endif
}

}  // namespace

int main(int argc, char** argv) {
  require_fitting_blas(argv);
  CLI::App app(
      "Measures what Lapwing costs, stage by stage over meshes of 1,000 to 1,000,000 vertices, "
      "beside what else does the same work and beside the limits of the device.",
      "lapwing-bench");
  app.require_subcommand(0, 1);
  RunOptions options;
  add_run(app, options);
  Studies studies;
  add_studies(app, studies);
  try {
    app.parse(argc, argv);
    if (!app.get_subcommands().empty()) return 0;
    std::string command_line = "lapwing-bench";
    for (int i = 1; i < argc; ++i) command_line += std::string(" ") + argv[i];
    if (options.show.empty()) {
      run(options, command_line);
    } else {
      show(options);
    }
    return 0;
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : 2;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "lapwing-bench: %s\n", error.what());
    return 1;
  }
}
