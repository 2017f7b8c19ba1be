#include <cstdio>
#include <memory>
#include <string>

#include <CLI/CLI.hpp>

#include "commands.h"
#include "lapwing/io/mesh_file.h"
#include "lapwing/kernels/cpu_kernels.h"
#include "lapwing/run/run_step.h"
#include "lapwing/wrap/wrap.h"
#include "messages.h"
#include "output_files.h"
#include "progress_display.h"

namespace lapwing::cli {
namespace {

struct WrapArguments {
  std::string wrapped;
  std::string scan;
  std::string output;
  std::string landmarks;
  bool aligned = false;
  bool strict = false;
  bool quiet = false;
};

const char* words_of(AlignmentMethod method) {
  switch (method) {
    case AlignmentMethod::none:
      return "as it is";
    case AlignmentMethod::landmarks:
      return "by the landmarks";
    case AlignmentMethod::surfaces:
      return "by the surfaces";
  }
  return "";
}

void print_distance(const char* name, const SurfaceDistance& distance, double diagonal) {
  std::printf("  %-18s mean %.4f%%, 95th percentile %.4f%%, largest %.4f%%\n", name,
              100.0 * distance.mean / diagonal, 100.0 * distance.percentile_95 / diagonal,
              100.0 * distance.max / diagonal);
}

void print_report(const WrapReport& report, double diagonal) {
  std::printf("  aligned %s, scaled by %.4g; %d steps\n", words_of(report.alignment.method),
              report.alignment.scale, report.steps);
  std::printf("  distances, in percent of the scan's diagonal:\n");
  print_distance("result to scan", report.to_scan, diagonal);
  print_distance("scan to result", report.to_template, diagonal);
  std::printf("  %.1f%% of the template has a counterpart on the scan\n", 100.0 * report.coverage);
  if (report.landmark_error > 0.0) {
    std::printf("  largest error of a landmark %.4f%%\n", 100.0 * report.landmark_error / diagonal);
  }
  std::printf("  flipped triangles %zu\n", report.flipped_triangles);
}

void wrap_mesh(const WrapArguments& a) {
  OutputFiles files;
  files.reads("TEMPLATE", a.wrapped, true);
  files.reads("SCAN", a.scan);
  files.reads("--landmarks", a.landmarks);
  files.writes_mesh("--output", a.output);
  Mesh mesh = read_with_notes(a.wrapped);
  const Mesh scan = read_with_notes(a.scan);
  WrapRequest request{.aligned = a.aligned};
  if (!a.landmarks.empty()) {
    request.landmarks.rows = read_target_rows(a.landmarks);
    request.landmarks.where = a.landmarks;
  }
  Wrapped wrapped;
  {
    ProgressDisplay display(a.quiet);
    CpuKernels kernels;
    wrapped = wrap(mesh, scan, request, kernels, display.callback());
  }
  mesh.positions = std::move(wrapped.positions);
  print_notes(write_mesh(mesh, a.output));
  if (!a.quiet) {
    std::printf("%s: %s wrapped onto %s\n", shown(a.output).c_str(), shown(a.wrapped).c_str(),
                shown(a.scan).c_str());
    print_report(wrapped.report, bounds_of(scan.positions).diagonal());
  }
  const std::string trouble = why_failed(wrapped.report, mesh.topology().triangles.size());
  if (trouble.empty()) return;
  warn(trouble);
  if (a.strict) throw ExitWith{kSolver};
}

}  // namespace

void add_wrap(CLI::App& app) {
  auto* command = app.add_subcommand(
      "wrap",
      "deforms a template so that it covers a scan; the result keeps the template's triangles");
  auto a = std::make_shared<WrapArguments>();
  command->add_option("TEMPLATE", a->wrapped, kMeshHelp)->required();
  command->add_option("SCAN", a->scan, kMeshHelp)->required();
  command->add_option("-o,--output", a->output, "the template on the scan")->required();
  command->add_option(
      "--landmarks", a->landmarks,
      "a table (.csv, .txt, .npy, .fcsv) of corresponding points. Each row contains the number of "
      "a template vertex, counted from 0, and the x, y, z of its position on the scan; or six "
      "numbers, a point of the template and its position on the scan. A weight may follow");
  command->add_flag("--aligned", a->aligned,
                    "the template is already in place; do not align it first");
  command->add_flag("--strict", a->strict, "exit code 4 if the wrap has failed");
  command->add_flag("-q,--quiet", a->quiet, "print only warnings");
  command->callback([a] { wrap_mesh(*a); });
}

}  // namespace lapwing::cli
