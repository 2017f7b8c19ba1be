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
  bool morph_targets = false;
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

// A pose of the source, and the file or the morph target to which its transfer is written.
struct Pose {
  std::string name;
  fs::path input;  // empty for a morph target
  fs::path output;
  Positions positions = {};
};

// Lists the files of all poses without reading them. A folder contributes its mesh files in the
// order of their names. A single pose file has a single output file; otherwise the output is a
// folder.
std::vector<Pose> pose_files(const TransferArguments& a) {
  std::vector<fs::path> inputs;
  bool is_single = a.poses.size() == 1;
  for (const std::string& pose : a.poses) {
    if (!fs::is_directory(pose)) {
      inputs.emplace_back(pose);
      continue;
    }
    is_single = false;
    std::vector<fs::path> found;
    for (const fs::directory_entry& entry : fs::directory_iterator(pose)) {
      if (is_mesh_file(entry.path())) found.push_back(entry.path());
    }
    if (found.empty()) throw InputError(pose + ": the folder contains no mesh files");
    std::ranges::sort(found);
    inputs.insert(inputs.end(), found.begin(), found.end());
  }
  std::vector<Pose> poses;
  std::set<std::string> names;
  for (const fs::path& input : inputs) {
    const std::string stem = split_mesh_path(input).file.stem().string();
    if (!names.insert(stem).second) {
      throw InputError(input.string() + ": another pose is also named " + stem +
                       ", and results are named after their poses. Rename a file.");
    }
    fs::path output = is_single ? fs::path(a.output) : fs::path(a.output) / stem;
    if (!is_single) output += split_mesh_path(a.target).file.extension();
    poses.push_back({shown(input), input, std::move(output)});
  }
  if (!is_single) make_folder(a.output);
  return poses;
}

std::vector<Pose> morph_poses(const TransferArguments& a, const Mesh& rest) {
  std::vector<Pose> poses;
  for (MorphTarget& target : read_morph_targets(rest)) {
    poses.push_back({std::move(target.name), {}, a.output, std::move(target.positions)});
  }
  if (poses.empty()) {
    throw InputError("--morph-targets: " + a.rest +
                     " has no morph targets; give a glTF file that has some, or files of poses");
  }
  return poses;
}

// Reads the source at rest and its poses, after checking that no output replaces an input.
std::vector<Pose> read_poses(const TransferArguments& a, Mesh& rest) {
  std::vector<Pose> poses;
  if (!a.morph_targets) poses = pose_files(a);
  OutputFiles files;
  files.reads("REST", a.rest);
  for (const Pose& pose : poses) files.reads("POSED", pose.input);
  files.reads("--onto", a.target);
  for (const std::string& file : a.landmarks) files.reads("--landmarks", file);
  files.reads("--correspondence", a.correspondence);
  for (const Pose& pose : poses) files.writes_mesh("--output", pose.output);
  if (a.morph_targets) files.writes_mesh("--output", a.output);
  rest = read_with_notes(a.rest);
  if (a.morph_targets) return morph_poses(a, rest);
  for (Pose& pose : poses) {
    pose.positions = read_with_notes(pose.input).positions;
    require_pose(rest, pose.positions, pose.input.string());
  }
  return poses;
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

void print_pose(const Pose& pose, const TransferReport& report) {
  std::printf("%s: %s %s\n", shown(pose.output).c_str(),
              pose.input.empty() ? "morph target" : "pose", pose.name.c_str());
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
  if (a.morph_targets == !a.poses.empty()) {
    throw CLI::RequiredError("either POSED or --morph-targets");
  }
  Mesh rest;
  const std::vector<Pose> poses = read_poses(a, rest);
  Mesh target = read_with_notes(a.target);
  std::optional<TransferSolver> solver;
  {
    ProgressDisplay display(a.quiet);
    CpuKernels kernels;
    solver.emplace(rest, target, request_of(a, rest, target), kernels, display.callback());
  }
  if (!a.quiet) print_counterparts(*solver, rest);
  for (const std::string& warning : solver->warnings()) warn(warning);
  std::vector<MorphTarget> morph_targets;
  for (const Pose& pose : poses) {
    Transferred result = solver->solve(pose.positions);
    if (a.morph_targets) {
      morph_targets.push_back({pose.name, std::move(result.positions)});
    } else {
      target.positions = std::move(result.positions);
      print_notes(write_mesh(target, pose.output));
    }
    if (!a.quiet) print_pose(pose, result.report);
  }
  if (a.morph_targets) {
    print_notes(write_mesh(target, a.output, {.morph_targets = std::move(morph_targets)}));
  }
  if (a.strict && !solver->warnings().empty()) throw ExitWith{kSolver};
}

}  // namespace

void add_transfer(CLI::App& app) {
  auto* command = app.add_subcommand(
      "transfer", "transfers poses of a mesh to another mesh, such as those of a horse to a camel");
  auto a = std::make_shared<TransferArguments>();
  command->add_option("REST", a->rest, "the source mesh, at rest")->required();
  command->add_option(
      "POSED", a->poses,
      "poses of REST, with the same vertices in the same order, or folders of poses");
  command->add_flag("--morph-targets", a->morph_targets,
                    "transfer the morph targets of REST, a glTF file, to TARGET, another one");
  command->add_option("--onto", a->target, "the target mesh, at rest")->required();
  command
      ->add_option("-o,--output", a->output,
                   "the target in the pose; for several poses, a folder with a file for each; "
                   "for morph targets, the target with these")
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
