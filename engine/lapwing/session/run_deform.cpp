#include "lapwing/session/run_deform.h"

#include "lapwing/deform/handle_motion.h"
#include "lapwing/session/commits.h"
#include "lapwing/session/stage.h"
#include "lapwing/session/winding.h"

namespace lapwing {
namespace {

using Eigen::Vector3d;

// The mesh follows the handles from share `from` of the step to share `to`.
Certificate run_part(const BoundStep& bound, double from, double to, Kernels& kernels,
                     const Progress& progress, RunResult& result, StageTimings& timings) {
  result.last.reset();
  if (!result.prepared) result.prepared = std::make_unique<PreparedRegion>(result.topology);
  result.last =
      std::make_unique<Deformer>(*result.prepared, result.mesh.positions, bound.region,
                                 deform_options(bound.step.parameters), kernels, progress);
  Deformer& deformer = *result.last;
  for (const auto& [name, ms] : deformer.timings().stages()) timings.add(name, ms);
  const std::vector<Eigen::Affine3d> motions = bound.motions(from, to);
  Certificate certificate;
  stage("drag", timings, progress, [&] { deformer.drag(motions); });
  stage("solve", timings, progress, [&] {
    DeformResult solved = deformer.solve(motions, bound.turns(from, to), progress);
    result.mesh.positions = std::move(solved.positions);
    certificate = std::move(solved.certificate);
    if (bound.step.parameters.settle) deformer.show(result.mesh.positions);
  });
  return certificate;
}

Certificate run_in_parts(const BoundStep& bound, const Positions& start, std::size_t count,
                         Kernels& kernels, const Progress& progress, RunResult& result,
                         StageTimings& timings) {
  const auto share = [&](std::size_t parts) {
    return static_cast<double>(parts) / static_cast<double>(count);
  };
  std::vector<Certificate> parts;
  for (std::size_t k = 0; k < count; ++k) {
    parts.push_back(run_part(bound, share(k), share(k + 1), kernels, progress, result, timings));
  }
  Certificate certificate;
  stage("certify", timings, progress,
        [&] { certificate = certify(bound, start, result.mesh.positions, parts); });
  return certificate;
}

}  // namespace

StepReport run_step(const DeformStep& step, std::size_t number, Kernels& kernels,
                    const Progress& progress, RunResult& result) {
  StepReport report;
  report.op = "deform";
  const LargestTurn largest = largest_turn(step);
  report.turn_degrees = largest.turn.degrees;
  report.commits = commit_count(step, number);
  EditRegion region;
  stage("region", report.timings, progress, [&] {
    std::vector<RegionSpec> handles;
    for (const MovedHandle& handle : step.handles) handles.push_back(handle.region);
    region = resolve_edit_region(step.roi, step.belt, handles, result.mesh, result.topology);
  });
  const Positions start = result.mesh.positions;
  std::vector<Vector3d> centroids;
  for (const VertexSet& handle : region.handles) {
    centroids.push_back(handle_frame(handle, start).centroid);
  }
  const BoundStep bound{step, region, result.topology, centroids};
  report.certificate =
      report.commits == 1
          ? run_part(bound, 0.0, 1.0, kernels, progress, result, report.timings)
          : run_in_parts(bound, start, report.commits, kernels, progress, result, report.timings);
  report.wound_degrees = wound_degrees(bound, largest, start, result.mesh.positions);
  if (std::string warning = winding_warning(step, number, report.wound_degrees); !warning.empty()) {
    result.report.warnings.push_back(std::move(warning));
  }
  for (const std::string& warning : warnings_of(report.certificate)) {
    result.report.warnings.push_back("step " + std::to_string(number) + ": " + warning);
  }
  report.roi = region.roi.size();
  report.belt = region.belt.size();
  for (const VertexSet& handle : region.handles) report.handles.push_back(handle.size());
  report.free = result.last->free_count();
  if (const std::string& why = report.certificate.why_not_exact; !why.empty()) {
    result.report.warnings.push_back("step " + std::to_string(number) + ": " + why +
                                     "; the step is settled without");
  }
  result.region = std::move(region);
  report.solver = result.last->solver_name();
  return report;
}

}  // namespace lapwing
