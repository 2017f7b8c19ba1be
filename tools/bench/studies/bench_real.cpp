#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <functional>

#include "lapwing/base/errors.h"
#include "lapwing/base/printable_text.h"
#include "lapwing/base/stopwatch.h"
#include "lapwing/deform/deform_request.h"
#include "lapwing/deform/deform_solver.h"
#include "lapwing/io/atomic_file.h"
#include "lapwing/io/file_bytes.h"
#include "lapwing/io/mesh_file.h"
#include "lapwing/io/mesh_format.h"
#include "lapwing/kernels/cpu_kernels.h"
#include "report/number_text.h"
#include "run/apart.h"
#include "run/cgal_arap.h"
#include "run/host.h"
#include "studies/ends_motion.h"
#include "studies/real_report.h"
#include "studies/smooth_arap.h"
#include "studies/studies.h"

namespace lapwing::bench {
namespace {

namespace fs = std::filesystem;
using Eigen::Affine3d;

constexpr std::size_t kLeastVertices = 100;

// One motion of one mesh, ready to run.
struct RealEdit {
  const Mesh& mesh;
  const std::vector<double>& weights;  // for the detail error
  EditRegion region;
  Affine3d map;
  std::size_t run;  // index of the edit's run in RealMesh::runs
};

// Returns the largest distance of a vertex of the belt or the handle from its prescribed position,
// over the largest prescribed displacement.
double constraint_error(const RealEdit& edit, const Positions& positions) {
  const Positions& rest = edit.mesh.positions;
  double error = 0.0;
  double displacement = 0.0;
  for (const Index v : edit.region.belt) error = std::max(error, (positions[v] - rest[v]).norm());
  for (const Index v : edit.region.handles[0]) {
    const Eigen::Vector3d prescribed = edit.map * rest[v];
    error = std::max(error, (positions[v] - prescribed).norm());
    displacement = std::max(displacement, (prescribed - rest[v]).norm());
  }
  return error / displacement;
}

// Only the linear response, which drags use.
DeformOptions linear_options() {
  DeformOptions options = DeformParameters{};
  options.settle.reset();
  return options;
}

// Returns the largest ratio of length to rest length among the edges at the vertices `rows`. An
// edge that is not stretched has the ratio 1. Ignores edges whose rest length is zero.
double largest_edge_ratio(std::span<const Index> rows, const Topology& topology,
                          std::span<const Eigen::Vector3d> rest,
                          std::span<const Eigen::Vector3d> current) {
  double largest = 0.0;
  for (const Index i : rows) {
    for (const Index j : topology.rings[i]) {
      const double was = (rest[i] - rest[j]).norm();
      if (was > 0.0) largest = std::max(largest, (current[i] - current[j]).norm() / was);
    }
  }
  return largest;
}

// Measures the deformed shape. Throws SolverError if a measure is not finite.
void measure_outcome(const RealEdit& edit, const Positions& positions, RealOutcome& outcome) {
  const Positions& rest = edit.mesh.positions;
  Certificate measures;
  measure_region(edit.region, edit.mesh.topology(), edit.weights, rest, positions, measures);
  outcome.flipped_triangles = measures.flipped_triangles;
  // The detail error of a flat surface is NaN, because such a surface has no detail.
  outcome.detail_error = std::isnan(measures.detail_error) ? 0.0 : measures.detail_error;
  outcome.edge_stretch = measures.edge_stretch;
  outcome.largest_edge = largest_edge_ratio(edit.region.roi, edit.mesh.topology(), rest, positions);
  outcome.constraint_error = constraint_error(edit, positions);
  outcome.measured = measures.all_finite && std::isfinite(outcome.detail_error) &&
                     std::isfinite(outcome.edge_stretch) && std::isfinite(outcome.largest_edge);
  if (!outcome.measured) throw SolverError("not finite");
}

void deform_by_ours(const RealEdit& edit, const DeformOptions& options, RealOutcome& outcome) {
  CpuKernels kernels;
  const Stopwatch preparing;
  const DeformSolver deformer(edit.mesh.positions, edit.mesh.topology(), edit.region, options,
                              kernels);
  outcome.prepare_ms = preparing.elapsed_ms();
  const Stopwatch solving;
  const DeformResult result = deformer.solve(std::array{edit.map});
  outcome.solve_ms = solving.elapsed_ms();
  outcome.settled = result.certificate.settled;
  outcome.iterations = result.certificate.settle_iterations;
  measure_outcome(edit, result.positions, outcome);
}

// Iterates from rest with a method that alternates between rotations and positions, already
// prepared.
template <class Arap>
void iterate(Arap& arap, const RealEdit& edit, int most_iterations, RealOutcome& outcome) {
  const Stopwatch solving;
  arap.move(std::array{edit.map});
  constexpr double kArapTolerance = 1e-6;  // relative change of the energy
  outcome.iterations = arap.iterate(most_iterations, kArapTolerance);
  outcome.solve_ms = solving.elapsed_ms();
  outcome.settled = outcome.iterations < most_iterations;
  measure_outcome(edit, arap.positions(), outcome);
}

void deform_by_smooth_arap(const RealEdit& edit, int most_iterations, RealOutcome& outcome) {
  const Stopwatch preparing;
  SmoothArap arap(edit.mesh, edit.region);
  outcome.prepare_ms = preparing.elapsed_ms();
  iterate(arap, edit, most_iterations, outcome);
}

void deform_by_cgal([[maybe_unused]] const RealEdit& edit, [[maybe_unused]] int most_iterations,
                    [[maybe_unused]] RealOutcome& outcome) {
#ifdef LAPWING_HAVE_CGAL
  const Stopwatch preparing;
  const auto arap = make_cgal_arap(edit.mesh, edit.region, ArapVariant::original);
  arap->prepare();
  outcome.prepare_ms = preparing.elapsed_ms();
  iterate(*arap, edit, most_iterations, outcome);
#else
  throw Error("not built with CGAL");
#endif
}

// Shortens an error message for a table by removing the advice after a semicolon.
std::string shortened(const std::string& message) {
  constexpr std::size_t kMostCharacters = 90;
  return clipped(message.substr(0, message.find(';')), kMostCharacters);
}

// Runs `work`. An exception becomes the outcome's failure.
template <class Work>
void try_to(const Work& work, RealOutcome& outcome) {
  try {
    work();
  } catch (const std::exception& error) {
    outcome.measured = false;
    outcome.failure = shortened(error.what());
  }
}

// Returns why the study passes over a mesh; empty if it does not.
std::string skip_reason(const Mesh& mesh, std::size_t most_vertices) {
  const std::size_t n = mesh.vertex_count();
  if (mesh.topology().triangles.empty()) return "no triangles";
  if (n < kLeastVertices) return "fewer than " + grouped(kLeastVertices) + " vertices";
  if (most_vertices > 0 && n > most_vertices)
    return "more than " + grouped(most_vertices) + " vertices";
  return {};
}

// Returns an edit for each motion that has a valid region. Adds a run to `all` for every motion. If
// the region is invalid, the run contains the error message.
std::vector<RealEdit> ready_edits(const Mesh& mesh, const std::vector<double>& weights,
                                  const std::string& name, RealMesh& all) {
  const Topology& topology = mesh.topology();
  std::vector<RealEdit> ready;
  for (const EndsMotion motion : kEndsMotions) {
    RealRun& run = all.runs.emplace_back();
    run.mesh = name;
    run.motion = name_of(motion);
    run.vertices = mesh.vertex_count();
    run.triangles = topology.triangles.size();
    try {
      const MovedEnds ends = moved_ends(motion, mesh.positions);
      HeldRegion held = held_region(ends, mesh.positions, topology);
      run.left_out = held.left_out;
      ready.push_back({mesh, weights, std::move(held.region), ends.map, all.runs.size() - 1});
    } catch (const InputError& error) {
      run.failure = shortened(error.what());
    }
  }
  return ready;
}

// Deforms one mesh by both motions with every method, Lapwing first. After each result, calls
// `done` with all results so far. `name` is the name of the mesh in the results.
void run_real_mesh(const fs::path& path, const std::string& name, const RealBench& settings,
                   const std::function<void(const RealMesh&)>& done) {
  RealMesh all;
  Mesh mesh;
  try {
    mesh = read_mesh(path);
    all.passed_over = skip_reason(mesh, settings.most_vertices);
  } catch (const Error& error) {
    const std::string message = error.what();
    const std::string place = path.string();
    all.passed_over =
        shortened(message.starts_with(place) ? "not read" + message.substr(place.size()) : message);
  }
  if (!all.passed_over.empty()) {
    done(all);
    return;
  }
  // All methods are measured with these weights.
  const std::vector<double> weights =
      laplacian_weights(mesh.topology(), mesh.positions, DeformParameters{}.weights);
  const std::vector<RealEdit> edits = ready_edits(mesh, weights, name, all);
  done(all);
  const int most = settings.arap_iterations;
  const auto deform_all = [&](RealOutcome RealRun::*outcome, const auto& deform) {
    for (const RealEdit& edit : edits) {
      RealOutcome& result = all.runs[edit.run].*outcome;
      try_to([&] { deform(edit, result); }, result);
      done(all);
    }
  };
  deform_all(&RealRun::ours, [](const RealEdit& edit, RealOutcome& outcome) {
    deform_by_ours(edit, DeformParameters{}, outcome);
  });
  deform_all(&RealRun::linear, [](const RealEdit& edit, RealOutcome& outcome) {
    deform_by_ours(edit, linear_options(), outcome);
  });
  deform_all(&RealRun::arap, [most](const RealEdit& edit, RealOutcome& outcome) {
    deform_by_cgal(edit, most, outcome);
  });
  deform_all(&RealRun::smooth_arap, [most](const RealEdit& edit, RealOutcome& outcome) {
    deform_by_smooth_arap(edit, most, outcome);
  });
}

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
                    "; `tools/setup/fetch-models build/models` fetches the meshes; or give the "
                    "files or folders to measure");
    }
  }
  std::erase_if(files, [&](const MeshFile& file) {
    return file.name.find(settings.only) == std::string::npos;
  });
  return files;
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
        run_real_mesh(file.path, file.name, settings,
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
      if (!outcome->measured && outcome->failure.empty()) outcome->failure = failure;
    }
  }
  return mesh;
}

void write_json(const RealBench& settings, const RealReport& report) {
  if (!settings.json.empty()) replace_file(settings.json, to_json(report));
}

RealReport measured_report(const RealBench& settings) {
  const Stopwatch watch;
  const Host host = this_host();
  RealReport report{now_utc(), built_from(), host.processor, host.threads};
  const std::vector<MeshFile> files = mesh_files(settings);
  std::fputs(real_heading().c_str(), stdout);
  for (const MeshFile& file : files) {
    const RealMesh mesh = run_apart(file, settings);
    if (!mesh.passed_over.empty()) report.passed_over.push_back({file.name, mesh.passed_over});
    for (const RealRun& run : mesh.runs) {
      std::fputs(line_of(run).c_str(), stdout);
      report.runs.push_back(run);
    }
    std::fflush(stdout);
    report.seconds = watch.elapsed_ms() / 1e3;
    // Write after each mesh, so that a failure does not lose earlier results.
    write_json(settings, report);
  }
  return report;
}

}  // namespace

void bench_real(const RealBench& settings) {
  if (!settings.json.empty()) require_replaceable(settings.json);
  RealReport report;
  if (settings.show.empty()) {
    report = measured_report(settings);
  } else {
    report = parse_real_report(FileBytes::read(settings.show).view(), settings.show);
    std::fputs(real_heading().c_str(), stdout);
    for (const RealRun& run : report.runs) std::fputs(line_of(run).c_str(), stdout);
  }
  std::printf("\n%s", text_of(report).c_str());
  write_json(settings, report);
}

}  // namespace lapwing::bench
