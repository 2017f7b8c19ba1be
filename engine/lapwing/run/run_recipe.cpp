#include "lapwing/run/run_recipe.h"

#include <variant>

#include "lapwing/base/cancellation.h"
#include "lapwing/base/counted.h"
#include "lapwing/base/memory_use.h"
#include "lapwing/base/stopwatch.h"
#include "lapwing/doctor/check.h"
#include "lapwing/mesh/seams.h"
#include "lapwing/mesh/topology.h"

namespace lapwing {
namespace {

std::vector<std::string> doctor_warnings(const CheckReport& report) {
  std::vector<std::string> warnings;
  for (const Defect& defect : report.defects) {
    const DefectInfo& info = describe(defect.kind);
    if (info.severity == Severity::info) continue;
    std::string text =
        info.element == Element::none ? std::string(info.name) : counted(defect.count, info.name);
    for (std::size_t i = 0; i < defect.first.size(); ++i) {
      text += (i == 0 ? " (" : ", ") + std::to_string(defect.first[i]);
    }
    if (!defect.first.empty()) text += defect.first.size() < defect.count ? ", ...)" : ")";
    warnings.push_back(text + ": " + std::string(info.meaning));
  }
  return warnings;
}

VertexMeasures measure_vertices(const VertexSet& vertices, const Topology& topology,
                                LaplacianWeights chosen, const Positions& before,
                                const Positions& after) {
  const auto weights = laplacian_weights(topology, before, chosen, vertices);
  return measure_vertices(vertices, topology, weights, before, after);
}

// Measures the surface with joined seams. A follower has the values of its leader.
VertexMeasures measure_joined(const VertexSet& vertices, const JoinedSurface& joined,
                              LaplacianWeights chosen, const Positions& before,
                              const Positions& after) {
  VertexSet leaders;
  for (const Index v : vertices) leaders.push_back(joined.leaders[v]);
  const VertexMeasures of_leaders =
      measure_vertices(make_vertex_set(leaders), joined.surface.topology(), chosen, before, after);
  const std::vector<Index> places = inverse_index(of_leaders.vertices, joined.leaders.size());
  VertexMeasures all;
  for (const Index v : vertices) {
    const Index k = places[joined.leaders[v]];
    all.vertices.push_back(v);
    all.rotation_degrees.push_back(of_leaders.rotation_degrees[k]);
    all.detail_error.push_back(of_leaders.detail_error[k]);
    all.stretch.push_back(of_leaders.stretch[k]);
  }
  return all;
}

// Measures each vertex of the last step's region.
template <class SomeStep>
VertexMeasures measure_step(const SomeStep& step, const Positions& before,
                            const RunResult& result) {
  const Mesh& mesh = result.mesh;
  const VertexSet& roi = result.region.roi;
  LaplacianWeights chosen = DeformParameters{}.weights;
  if constexpr (requires { step.parameters.weights; }) chosen = step.parameters.weights;
  const JoinedSurface joined = joined_surface(mesh);
  if (joined.empty() || !joined.is_closed_at(before)) {
    return measure_vertices(roi, mesh.topology(), chosen, before, mesh.positions);
  }
  return measure_joined(roi, joined, chosen, before, mesh.positions);
}

}  // namespace

void begin_run(const Recipe& recipe, const MeshCache& meshes, Kernels& kernels,
               const Progress& progress, RunResult& result) {
  RunReport& report = result.report;
  report.device = kernels.device();
  const auto path = recipe.mesh_path();
  report.mesh = path.lexically_normal().string();
  result.inputs.push_back(split_mesh_path(path).file);
  result.morph_target = recipe.morph_target;
  stage("read", report.timings, progress,
        [&] { result.mesh = *meshes.mesh(recipe.base_directory, recipe.mesh); });
  result.note(reading_notes(result.mesh));
  result.original = result.mesh.positions;
  result.read_from = result.mesh.source;
  stage("topology", report.timings, progress, [&] { result.mesh.topology(); });
  stage("check", report.timings, progress, [&] {
    const CheckReport check_report = check(result.mesh);
    report.warnings = doctor_warnings(check_report);
    report.components = check_report.statistics.component_sizes.size();
    report.bounds = bounds_of(surface_positions(result.mesh.positions, result.mesh.topology()));
  });
  report.vertices = result.mesh.vertex_count();
  report.faces = result.mesh.face_count();
  report.triangles = result.mesh.topology().triangles.size();
}

void run_next_step(const Recipe& recipe, const MeshCache& meshes, Kernels& kernels,
                   const Progress& progress, RunResult& result) {
  std::vector<StepReport>& reports = result.report.steps;
  const Step& step = recipe.steps[reports.size()];
  reports.push_back(run_step(
      step, {reports.size() + 1, recipe.base_directory, kernels, progress, result, meshes}));
}

std::unique_ptr<RunResult> run_recipe(const Recipe& recipe, Kernels& kernels,
                                      const Progress& progress, const RunOptions& options) {
  const ProgressScope scope(progress);
  auto result = std::make_unique<RunResult>();
  const MeshCache files;
  const MeshCache& meshes = options.meshes != nullptr ? *options.meshes : files;
  begin_run(recipe, meshes, kernels, progress, *result);
  for (const Step& step : recipe.steps) {
    const Mesh before = options.measure_vertices ? result->mesh : Mesh();
    run_next_step(recipe, meshes, kernels, progress, *result);
    StepReport& report = result->report.steps.back();
    if (!options.measure_vertices || !before.shares_faces_with(result->mesh)) continue;
    stage("measure_vertices", report.timings, progress, [&] {
      report.vertices = std::visit(
          [&](const auto& s) { return measure_step(s, before.positions, *result); }, step);
    });
  }
  result->report.peak_memory_bytes = peak_memory_bytes();
  return result;
}

}  // namespace lapwing
