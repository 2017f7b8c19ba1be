#include "lapwing/session/run_deform.h"

#include "lapwing/base/errors.h"
#include "lapwing/deform/commits.h"

namespace lapwing {

StepReport run_step(const DeformRequest& step, std::size_t number, Kernels& kernels,
                    const Progress& progress, RunResult& result) {
  const std::string where = "step " + std::to_string(number) + ": ";
  try {
    commit_count(step);
  } catch (const InputError& error) {
    throw InputError(where + error.what());
  }
  Deformed done =
      deform(std::move(result.mesh), result.topology, step, kernels, result.deformed, progress);
  result.mesh = std::move(done.mesh);
  for (const std::string& warning : done.warnings) {
    result.report.warnings.push_back(where + warning);
  }
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
