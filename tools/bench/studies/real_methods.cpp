#include "studies/real_methods.h"

#include <array>
#include <cmath>

#include "lapwing/base/errors.h"
#include "lapwing/base/grouped.h"
#include "lapwing/base/stopwatch.h"
#include "lapwing/deform/deform_request.h"
#include "lapwing/deform/deform_solver.h"
#include "lapwing/io/mesh_file.h"
#include "lapwing/kernels/cpu_kernels.h"
#include "report/number_text.h"
#include "run/cgal_arap.h"
#include "studies/real/edge_ratio.h"
#include "studies/real/ends_motion.h"
#include "studies/real/held_region.h"
#include "studies/real/smooth_arap.h"

namespace lapwing::bench {
namespace {

using Eigen::Affine3d;

constexpr std::size_t kLeastVertices = 100;

// Relative change of the energy at which ARAP stops iterating.
constexpr double kArapTolerance = 1e-6;

// Edges and Laplacians have the same weight.
constexpr double kSmoothArapLambda = 0.5;

// One motion of one mesh, ready to run.
struct RealEdit {
  const Mesh& mesh;
  const std::vector<double>& weights;  // for the detail error
  EditRegion region;
  Affine3d map;
};

DeformOptions default_options() {
  return DeformParameters{};
}

// Only the linear response, which drags use.
DeformOptions linear_options() {
  DeformOptions options = default_options();
  options.settle.reset();
  return options;
}

// Measures the deformed shape. Throws SolverError if a measure is not finite.
void measure_outcome(const RealEdit& edit, const Positions& positions, RealOutcome& outcome) {
  const Positions& rest = edit.mesh.positions;
  Certificate measures;
  measure_region(edit.region, edit.mesh.topology(), edit.weights, rest, positions, measures);
  outcome.flipped_triangles = measures.flipped_triangles;
  outcome.detail_error = measures.detail_error;
  outcome.edge_stretch = measures.edge_stretch;
  outcome.largest_edge = largest_edge_ratio(edit.region.roi, edit.mesh.topology(), rest, positions);
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

// Deforms from rest by `arap`, whose preparation took `prepare_ms`.
template <class Arap>
void iterate(Arap& arap, double prepare_ms, const RealEdit& edit, int most_iterations,
             RealOutcome& outcome) {
  outcome.prepare_ms = prepare_ms;
  const Stopwatch solving;
  arap.move(std::array{edit.map});
  outcome.iterations = arap.iterate(most_iterations, kArapTolerance);
  outcome.solve_ms = solving.elapsed_ms();
  outcome.settled = outcome.iterations < most_iterations;
  measure_outcome(edit, arap.positions(), outcome);
}

void deform_by_cgal([[maybe_unused]] const RealEdit& edit, [[maybe_unused]] int most_iterations,
                    [[maybe_unused]] RealOutcome& outcome) {
#ifdef LAPWING_HAVE_CGAL
  const Stopwatch preparing;
  CgalArap arap(edit.mesh, edit.region, ArapVariant::original);
  arap.prepare();
  iterate(arap, preparing.elapsed_ms(), edit, most_iterations, outcome);
#else
  throw Error("not built with CGAL");
#endif
}

void deform_by_smooth_arap(const RealEdit& edit, int most_iterations, RealOutcome& outcome) {
  const Stopwatch preparing;
  SmoothArap arap(edit.mesh, edit.region, kSmoothArapLambda);
  iterate(arap, preparing.elapsed_ms(), edit, most_iterations, outcome);
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

// An edit of `all.runs` that has something to deform, and the index of its run.
struct ReadyEdit {
  RealEdit edit;
  std::size_t run;
};
std::vector<ReadyEdit> ready_edits(const Mesh& mesh, const std::vector<double>& weights,
                                   const std::string& name, RealMesh& all) {
  const Topology& topology = mesh.topology();
  std::vector<ReadyEdit> ready;
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
      ready.push_back({{mesh, weights, std::move(held.region), ends.map}, all.runs.size() - 1});
    } catch (const InputError& error) {
      run.failure = shortened(error.what());
    }
  }
  return ready;
}

}  // namespace

std::string shortened(const std::string& message) {
  constexpr std::size_t kMostCharacters = 90;
  return clipped(std::string_view(message).substr(0, message.find(';')), kMostCharacters);
}

void run_real_mesh(const std::filesystem::path& path, const std::string& name,
                   const RealLimits& limits, const std::function<void(const RealMesh&)>& done) {
  RealMesh all;
  Mesh mesh;
  try {
    mesh = read_mesh(path);
    all.passed_over = skip_reason(mesh, limits.most_vertices);
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
      laplacian_weights(mesh.topology(), mesh.positions, default_options().weights);
  const std::vector<ReadyEdit> ready = ready_edits(mesh, weights, name, all);
  done(all);
  for (const ReadyEdit& each : ready) {
    RealRun& run = all.runs[each.run];
    try_to([&] { deform_by_ours(each.edit, default_options(), run.ours); }, run.ours);
    done(all);
    try_to([&] { deform_by_ours(each.edit, linear_options(), run.linear); }, run.linear);
    done(all);
  }
  for (const ReadyEdit& each : ready) {
    RealRun& run = all.runs[each.run];
    try_to([&] { deform_by_cgal(each.edit, limits.arap_iterations, run.arap); }, run.arap);
    done(all);
  }
  for (const ReadyEdit& each : ready) {
    RealRun& run = all.runs[each.run];
    try_to([&] { deform_by_smooth_arap(each.edit, limits.arap_iterations, run.smooth_arap); },
           run.smooth_arap);
    done(all);
  }
}

}  // namespace lapwing::bench
