#include "lapwing/session/run_coat.h"

#include "lapwing/base/stage.h"
#include "lapwing/io/mesh_file.h"

namespace lapwing {

std::vector<SharedSource> read_source_meshes(std::span<const FileSource> sources,
                                             const std::filesystem::path& base_directory) {
  std::vector<SharedSource> meshes;
  for (const FileSource& source : sources) {
    meshes.push_back(source.mesh.empty()
                         ? nullptr
                         : std::make_shared<const Mesh>(read_mesh(base_directory / source.mesh)));
  }
  return meshes;
}

StepReport take_over(const LayeredCoat& coat, const std::string& op, StageTimings source_timings,
                     Positions positions, RunResult& result) {
  StepReport report;
  report.op = op;
  report.roi = coat.target_patch().vertices.size();
  report.belt = coat.target_patch().loop.size();
  report.free = coat.free_count();
  report.timings = std::move(source_timings);
  const StageTimings timings = coat.timings();
  for (const auto& [name, ms] : timings.stages()) report.timings.add(name, ms);
  report.coat = coat.report(positions);
  result.region = {coat.target_patch().vertices, border_of(coat.target_patch()), {}};
  for (const TargetHandle& handle : coat.handles()) {
    report.handles.push_back(handle.vertices.size());
    result.region.handles.push_back(handle.vertices);
  }
  const auto& warnings = coat.warnings();
  result.report.warnings.insert(result.report.warnings.end(), warnings.begin(), warnings.end());
  if (const RemeshResult* remeshed = coat.remeshed()) {
    // What was read of vertices that are new is where they are.
    Positions original = remeshed->mesh.positions;
    for (std::size_t v = 0; v < original.size(); ++v) {
      if (remeshed->kept[v] != kNoIndex) original[v] = result.original[remeshed->kept[v]];
    }
    result.original = std::move(original);
    result.mesh = remeshed->mesh;
  }
  result.mesh.positions = std::move(positions);
  return report;
}

StepReport run_step(const CoatStep& step, const std::filesystem::path& base_directory,
                    Kernels& kernels, const Progress& progress, RunResult& result) {
  StageTimings timings;
  std::vector<SharedSource> sources;
  stage("source", timings, progress, [&] {
    sources = read_source_meshes({&step.source, 1}, base_directory);
  });
  const PreparedCoat coat({step.source, step.target_patch, step.parameters, step.where},
                          result.mesh, sources.front(), kernels, progress);
  return take_over(coat.layers(), "coat", std::move(timings), coat.positions(step.source.amplitude),
                   result);
}

}  // namespace lapwing
