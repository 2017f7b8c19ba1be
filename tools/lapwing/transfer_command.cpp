#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <system_error>
#include <vector>

#include <CLI/CLI.hpp>

#include "commands.h"
#include "lapwing/base/errors.h"
#include "lapwing/io/mesh_file.h"
#include "lapwing/io/mesh_format.h"
#include "lapwing/kernels/cpu_kernels.h"
#include "lapwing/run/run_step.h"
#include "lapwing/transfer/transfer.h"
#include "lapwing/wrap/landmarks.h"
#include "messages.h"
#include "output_files.h"
#include "progress_display.h"
#include "region_text.h"

namespace lapwing::cli {
namespace {

namespace fs = std::filesystem;

struct TransferArguments {
  std::string rest;
  std::vector<std::string> poses;
  std::string target;
  std::string output;
  std::vector<std::string> landmarks;
  std::string correspondence;
  std::string held;
  bool aligned = false;
  bool strict = false;
  bool quiet = false;
};

bool is_mesh_file(const fs::path& path) {
  try {
    static_cast<void>(format_of(path));
  } catch (const InputError&) {
    return false;
  }
  return fs::is_regular_file(path);
}

void make_folder(const fs::path& folder) {
  std::error_code error;
  fs::create_directories(folder, error);
  if (error) throw IoError("cannot create the folder " + folder.string() + ": " + error.message());
}

struct PoseFiles {
  std::vector<fs::path> inputs;
  std::vector<fs::path> outputs;
};

// Returns the files of all poses. A folder contributes its mesh files in the order of their names.
// A single pose file has a single output file; otherwise the output is a folder.
PoseFiles pose_files(const TransferArguments& a) {
  PoseFiles files;
  bool is_single = a.poses.size() == 1;
  for (const std::string& pose : a.poses) {
    if (!fs::is_directory(pose)) {
      files.inputs.emplace_back(pose);
      continue;
    }
    is_single = false;
    std::vector<fs::path> found;
    for (const fs::directory_entry& entry : fs::directory_iterator(pose)) {
      if (is_mesh_file(entry.path())) found.push_back(entry.path());
    }
    if (found.empty()) throw InputError(pose + ": the folder contains no mesh files");
    std::ranges::sort(found);
    files.inputs.insert(files.inputs.end(), found.begin(), found.end());
  }
  std::set<std::string> names;
  for (const fs::path& input : files.inputs) {
    const std::string stem = split_mesh_path(input).file.stem().string();
    if (!names.insert(stem).second) {
      throw InputError(input.string() + ": another pose is also named " + stem +
                       ", and results are named after their poses. Rename a file.");
    }
    files.outputs.push_back(is_single ? fs::path(a.output) : fs::path(a.output) / stem);
    if (!is_single) files.outputs.back() += split_mesh_path(a.target).file.extension();
  }
  if (!is_single) make_folder(a.output);
  return files;
}

TransferRequest request_of(const TransferArguments& a, const Mesh& rest, const Mesh& target) {
  TransferRequest request{.aligned = a.aligned};
  if (!a.landmarks.empty()) {
    LandmarkSpec landmarks{.file = a.landmarks[0]};
    if (a.landmarks.size() > 1) landmarks.scan_file = a.landmarks[1];
    std::vector<std::string> notes;
    landmarks = with_rows(std::move(landmarks), {}, notes);
    for (const std::string& text : notes) note(text);
    request.landmarks = targets_of(landmarks, target, rest);
  }
  if (!a.held.empty()) request.held = region_spec("--hold", a.held);
  if (!a.correspondence.empty()) {
    request.on_source = read_with_notes(a.correspondence).positions;
  }
  return request;
}

void print_pose(const fs::path& output, const fs::path& pose, const TransferReport& report) {
  std::printf("%s: pose %s\n", shown(output).c_str(), shown(pose).c_str());
  std::printf(
      "  largest rotation %.1f degrees, edge stretch %.1f%%, flipped triangles %zu, "
      "inside out %.1f%%\n",
      report.largest_rotation_degrees, 100.0 * report.edge_stretch, report.flipped_triangles,
      100.0 * report.inside_out_share);
}

void print_counterparts(const TransferSolver& solver, const Mesh& rest) {
  if (const auto& report = solver.wrap_report()) {
    std::printf("target wrapped onto the rest pose: mean distance %.4f%% of the diagonal\n",
                100.0 * report->to_scan.mean / bounds_of(rest.positions).diagonal());
  }
  std::printf("%.1f%% of the target has no counterpart\n", 100.0 * solver.unmatched_area());
}

void transfer_poses(const TransferArguments& a) {
  const PoseFiles poses = pose_files(a);
  OutputFiles files;
  files.reads("REST", a.rest);
  for (const fs::path& pose : poses.inputs) files.reads("POSED", pose);
  files.reads("--onto", a.target);
  for (const std::string& file : a.landmarks) files.reads("--landmarks", file);
  files.reads("--correspondence", a.correspondence);
  for (const fs::path& output : poses.outputs) files.writes_mesh("--output", output);
  const Mesh rest = read_with_notes(a.rest);
  Mesh target = read_with_notes(a.target);
  std::vector<Positions> posed;
  for (const fs::path& input : poses.inputs) {
    posed.push_back(read_with_notes(input).positions);
    require_pose(rest, posed.back(), input.string());
  }
  std::optional<TransferSolver> solver;
  {
    ProgressDisplay display(a.quiet);
    CpuKernels kernels;
    solver.emplace(rest, target, request_of(a, rest, target), kernels, display.callback());
  }
  if (!a.quiet) print_counterparts(*solver, rest);
  for (const std::string& warning : solver->warnings()) warn(warning);
  for (std::size_t k = 0; k < poses.inputs.size(); ++k) {
    Transferred result = solver->solve(posed[k]);
    target.positions = std::move(result.positions);
    print_notes(write_mesh(target, poses.outputs[k]));
    if (!a.quiet) print_pose(poses.outputs[k], poses.inputs[k], result.report);
  }
  if (a.strict && !solver->warnings().empty()) throw ExitWith{kSolver};
}

}  // namespace

void add_transfer(CLI::App& app) {
  auto* command = app.add_subcommand(
      "transfer", "transfers poses of a mesh to another mesh, such as those of a horse to a camel");
  auto a = std::make_shared<TransferArguments>();
  command->add_option("REST", a->rest, "the source mesh, at rest")->required();
  command
      ->add_option("POSED", a->poses,
                   "poses of REST, with the same vertices in the same order, or folders of poses")
      ->required();
  command->add_option("--onto", a->target, "the target mesh, at rest")->required();
  command
      ->add_option("-o,--output", a->output,
                   "the target in the pose; for several poses, a folder with a file for each")
      ->required();
  auto* landmarks =
      command
          ->add_option("--landmarks", a->landmarks,
                       "corresponding points of the target and of REST, as for `lapwing wrap "
                       "TARGET REST`")
          ->type_name("FILE [REST_FILE]")
          ->expected(1, 2);
  command
      ->add_option("--correspondence", a->correspondence,
                   "the target with its vertices on REST, as `lapwing wrap TARGET REST` saves it")
      ->excludes(landmarks);
  command->add_option(
      "--hold", a->held,
      std::string("vertices of the target that do not move, such as feet: ") + kRegionHelp);
  command->add_flag("--aligned", a->aligned,
                    "the target is already in place on REST; do not align it first");
  command->add_flag("--strict", a->strict, "exit code 4 if counterparts are missing or wrong");
  command->add_flag("-q,--quiet", a->quiet, "print only warnings");
  command->callback([a] { transfer_poses(*a); });
}

}  // namespace lapwing::cli
