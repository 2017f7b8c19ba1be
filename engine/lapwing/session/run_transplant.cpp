#include "lapwing/session/run_transplant.h"

#include "lapwing/base/stage.h"
#include "lapwing/io/mesh_file.h"

namespace lapwing {

std::optional<Mesh> read_part_mesh(const TransplantStep& step,
                                   const std::filesystem::path& base_directory) {
  if (step.part.empty()) return std::nullopt;
  return read_mesh(base_directory / step.part);
}

StepReport run_step(const TransplantStep& step, const std::filesystem::path& base_directory,
                    Kernels& kernels, const Progress& progress, RunResult& result) {
  StepReport report;
  report.op = "transplant";
  std::optional<Mesh> read;
  stage("part", report.timings, progress, [&] { read = read_part_mesh(step, base_directory); });
  const Mesh& part = read ? *read : result.mesh;
  const std::string name = read ? step.part.stem().string() : "part";
  Transplanted done = transplant(result.mesh, part, name, step, kernels, progress);
  for (const auto& [stage_name, ms] : done.timings.stages()) report.timings.add(stage_name, ms);
  result.report.warnings.insert(result.report.warnings.end(), done.warnings.begin(),
                                done.warnings.end());
  report.roi = done.region.size();
  report.belt = done.belt.size();
  report.free = report.roi - report.belt;
  report.transplant = std::move(done.report);
  Positions original = std::move(done.placed);
  for (std::size_t v = 0; v < original.size(); ++v) {
    const Index host = done.host_vertices[v];
    if (host != kNoIndex) original[v] = result.original[host];
  }
  result.original = std::move(original);
  result.mesh = std::move(done.mesh);
  result.region = {std::move(done.region), std::move(done.belt), {}};
  return report;
}

}  // namespace lapwing
