#include "lapwing/session/run_deform.h"

namespace lapwing {

StepReport run_step(const DeformRequest& step, std::size_t number, Kernels& kernels,
                    const Progress& progress, RunResult& result) {
  DeformRequest named = step;
  named.where = "step " + std::to_string(number);
  Deformed done = deform(std::move(result.mesh), named, kernels, result.deformed, progress);
  result.mesh = std::move(done.mesh);
  for (std::string& warning : done.warnings) result.report.warnings.push_back(std::move(warning));
  StepReport report;
  report.op = "deform";
  report.roi = done.region.roi.size();
  report.free = done.free;
  report.belt = done.region.belt.size();
  for (const VertexSet& handle : done.region.handles) report.handles.push_back(handle.size());
  report.solver = std::move(done.solver);
  report.turn_degrees = done.turn_degrees;
  report.wound_degrees = done.wound_degrees;
  report.commits = done.commits;
  report.timings = std::move(done.timings);
  report.certificate = std::move(done.certificate);
  result.region = std::move(done.region);
  return report;
}

}  // namespace lapwing
