#include "lapwing/session/run_deform.h"

#include "lapwing/deform/handle_motion.h"
#include "lapwing/session/commits.h"
#include "lapwing/session/stage.h"
#include "lapwing/session/turned_start.h"
#include "lapwing/session/winding.h"
#include "lapwing/settle/settle.h"

namespace lapwing {
namespace {

using Eigen::Vector3d;

DeformOptions options_of(const DeformStep& step) {
  DeformOptions options;
  options.weights = step.weights;
  options.constraint_weight = step.constraint_weight;
  options.hard = step.hard;
  options.settle = step.settle;
  return options;
}

// Prepares for the mesh as it is.
Deformer& prepare(const EditRegion& region, const DeformOptions& options, Kernels& kernels,
                  const Progress& progress, RunResult& result, StageTimings& timings) {
  // A factor is large: the one before goes first.
  result.last.reset();
  result.last = std::make_unique<Deformer>(result.mesh.positions, result.topology, region, options,
                                           kernels, progress);
  for (const auto& [name, ms] : result.last->timings().stages()) timings.add(name, ms);
  return *result.last;
}

// The mesh follows the handles in one go, from the linear solution.
Certificate run_at_once(const BoundStep& bound, Kernels& kernels, const Progress& progress,
                        RunResult& result, StageTimings& timings) {
  Deformer& deformer =
      prepare(bound.region, options_of(bound.step), kernels, progress, result, timings);
  const std::vector<Eigen::Affine3d> motions = bound.motions(0.0, 1.0);
  Certificate certificate;
  stage("drag", timings, progress, [&] { deformer.drag(motions); });
  stage("solve", timings, progress, [&] {
    DeformResult solved = deformer.solve(motions, progress);
    result.mesh.positions = std::move(solved.positions);
    certificate = std::move(solved.certificate);
    if (bound.step.settle) deformer.show(result.mesh.positions);
  });
  return certificate;
}

// Settles `positions` from the turned start.
void settle_part(const BoundStep& bound, double from, double to, const Progress& progress,
                 StageTimings& timings, Positions& positions, Certificate& certificate) {
  const Constraints constraints =
      constraints_of(bound.region, bound.topology, bound.step.constraint_weight, bound.step.hard);
  Settler settler(positions, bound.topology, bound.region.roi, constraints, *bound.step.settle,
                  progress, timings);
  stage("solve", timings, progress, [&] {
    std::vector<Vector3d> u = turned_start(bound, positions, from, to);
    for (std::size_t v = 0; v < u.size(); ++v) u[v] -= positions[v];
    std::vector<Vector3d> wanted(positions.size(), Vector3d::Zero());
    for (std::size_t h = 0; h < bound.region.handles.size(); ++h) {
      for (const Index v : bound.region.handles[h]) wanted[v] = u[v];
    }
    const SettleResult settled = settler.settle(wanted, u, progress);
    certificate.settle_iterations = settled.iterations;
    certificate.settled = settled.settled;
    certificate.settle_last_step = settled.last_step;
    for (const Index v : bound.region.roi) {
      // Adding 0 would turn a coordinate of -0 into +0.
      if (!u[v].isZero(0.0)) positions[v] += u[v];
    }
  });
}

// The mesh follows the handles from share `from` of the step to share `to` and is committed.
Certificate run_part(const BoundStep& bound, double from, double to, Kernels& kernels,
                     const Progress& progress, RunResult& result, StageTimings& timings) {
  DeformOptions options = options_of(bound.step);
  options.settle.reset();
  Deformer& deformer = prepare(bound.region, options, kernels, progress, result, timings);
  const std::vector<Eigen::Affine3d> motions = bound.motions(from, to);
  stage("drag", timings, progress, [&] { deformer.drag(motions); });
  DeformResult linear;
  stage("solve", timings, progress, [&] { linear = deformer.solve(motions, progress); });
  if (bound.step.settle) {
    settle_part(bound, from, to, progress, timings, result.mesh.positions, linear.certificate);
    deformer.show(result.mesh.positions);
  } else {
    result.mesh.positions = std::move(linear.positions);
  }
  return linear.certificate;
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
  if (step.commit_every && report.turn_degrees > 0.0) {
    report.certificate =
        run_in_parts(bound, start, report.commits, kernels, progress, result, report.timings);
  } else {
    report.certificate = run_at_once(bound, kernels, progress, result, report.timings);
  }
  report.wound_degrees = wound_degrees(bound, largest, start, result.mesh.positions);
  if (std::string warning = winding_warning(step, number, report.wound_degrees); !warning.empty()) {
    result.report.warnings.push_back(std::move(warning));
  }
  report.roi = region.roi.size();
  report.belt = region.belt.size();
  for (const VertexSet& handle : region.handles) report.handles.push_back(handle.size());
  report.free = result.last->free_count();
  report.solver = result.last->solver_name();
  return report;
}

}  // namespace lapwing
