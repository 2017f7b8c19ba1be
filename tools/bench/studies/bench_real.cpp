#include <algorithm>
#include <cstdio>
#include <filesystem>

#include "lapwing/base/errors.h"
#include "lapwing/base/stopwatch.h"
#include "lapwing/io/file_bytes.h"
#include "lapwing/io/mesh_format.h"
#include "report/text_file.h"
#include "run/apart.h"
#include "run/host.h"
#include "studies/real/ends_motion.h"
#include "studies/real/real_json.h"
#include "studies/real/real_table.h"
#include "studies/real_methods.h"
#include "studies/studies.h"

namespace lapwing::bench {
namespace {

namespace fs = std::filesystem;

struct MeshFile {
  fs::path path;
  std::string name;  // relative to the given folder
};

bool is_mesh_file(const fs::path& path) {
  try {
    format_of(path);
    return true;
  } catch (const InputError&) {
    return false;
  }
}

void add_folder(const fs::path& folder, std::vector<MeshFile>& files) {
  std::vector<MeshFile> found;
  for (const auto& entry : fs::recursive_directory_iterator(folder)) {
    if (!entry.is_regular_file() || !is_mesh_file(entry.path())) continue;
    found.push_back({entry.path(), entry.path().lexically_relative(folder).generic_string()});
  }
  std::sort(found.begin(), found.end(),
            [](const MeshFile& a, const MeshFile& b) { return a.name < b.name; });
  files.insert(files.end(), found.begin(), found.end());
}

std::vector<MeshFile> mesh_files(const RealBench& settings) {
  std::vector<MeshFile> files;
  for (const std::string& name : settings.paths) {
    const fs::path path(name);
    if (fs::is_directory(path)) {
      add_folder(path, files);
    } else if (fs::exists(path)) {
      files.push_back({path, path.filename().generic_string()});
    } else {
      throw IoError("there is no " + path.string() +
                    "; `tools/setup/fetch-models build/models` fetches the meshes");
    }
  }
  std::erase_if(files, [&](const MeshFile& file) {
    return file.name.find(settings.only) == std::string::npos;
  });
  return files;
}

void fail_what_is_missing(RealOutcome& outcome, const std::string& failure) {
  if (!outcome.measured && outcome.failure.empty()) outcome.failure = failure;
}

// Parses the last complete line. Returns an empty RealMesh if there is none.
RealMesh last_of(const std::string& lines) {
  const std::size_t end = lines.rfind('\n');
  if (end == std::string::npos) return {};
  const std::size_t before = end == 0 ? std::string::npos : lines.rfind('\n', end - 1);
  const std::size_t begin = before == std::string::npos ? 0 : before + 1;
  return parse_real_mesh(std::string_view(lines).substr(begin, end - begin));
}

// Runs a mesh in a separate process. If it takes too long or too much memory, or if CGAL crashes,
// only the missing results are lost.
RealMesh run_apart(const MeshFile& file, const RealBench& settings) {
  const Told told = run_in_child_process(
      [&](const auto& tell) {
        run_real_mesh(file.path, file.name, {settings.most_vertices, settings.arap_iterations},
                      [&](const RealMesh& so_far) { tell(to_json_line(so_far)); });
      },
      settings.seconds);
  RealMesh mesh = last_of(told.text);
  if (told.failure.empty()) return mesh;
  const std::string failure = shortened(told.failure);
  if (mesh.runs.empty() && mesh.passed_over.empty()) {
    for (const EndsMotion motion : kEndsMotions) {
      RealRun& run = mesh.runs.emplace_back();
      run.mesh = file.name;
      run.motion = name_of(motion);
    }
  }
  for (RealRun& run : mesh.runs) {
    if (!run.failure.empty()) continue;
    for (RealOutcome* outcome : {&run.ours, &run.linear, &run.arap, &run.smooth_arap}) {
      fail_what_is_missing(*outcome, failure);
    }
  }
  return mesh;
}

void write_all(const RealBench& settings, const RealReport& report) {
  if (!settings.json.empty()) write_text(settings.json, to_json(report));
  if (!settings.markdown.empty()) write_text(settings.markdown, markdown_of(report));
}

RealReport measured_report(const RealBench& settings) {
  const Stopwatch watch;
  const Host host = this_host();
  RealReport report{now_utc(), built_from(), host.processor, host.threads};
  for (const MeshFile& file : mesh_files(settings)) {
    const RealMesh mesh = run_apart(file, settings);
    if (!mesh.passed_over.empty()) report.passed_over.push_back({file.name, mesh.passed_over});
    for (const RealRun& run : mesh.runs) {
      std::fputs(line_of(run).c_str(), stdout);
      report.runs.push_back(run);
    }
    std::fflush(stdout);
    report.seconds = watch.elapsed_ms() / 1e3;
    // Write after each mesh, so that a failure does not lose earlier results.
    write_all(settings, report);
  }
  return report;
}

}  // namespace

void bench_real(const RealBench& settings) {
  for (const std::string& path : {settings.json, settings.markdown}) {
    if (!path.empty()) require_writable(path);
  }
  std::fputs(real_heading().c_str(), stdout);
  RealReport report;
  if (settings.show.empty()) {
    report = measured_report(settings);
  } else {
    report = parse_real_report(FileBytes::read(settings.show).view(), settings.show);
    for (const RealRun& run : report.runs) std::fputs(line_of(run).c_str(), stdout);
  }
  std::printf("\n%s", text_of(report).c_str());
  write_all(settings, report);
}

}  // namespace lapwing::bench
