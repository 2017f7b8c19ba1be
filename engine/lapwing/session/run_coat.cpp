#include "lapwing/session/run_coat.h"

#include <algorithm>
#include <cmath>

#include "lapwing/base/errors.h"
#include "lapwing/coating/coater.h"
#include "lapwing/coating/correspondence.h"
#include "lapwing/coating/fairing.h"
#include "lapwing/coating/peel.h"
#include "lapwing/io/mesh_file.h"
#include "lapwing/session/stage.h"

namespace lapwing {
namespace {

using Eigen::Vector3d;

// Where the coating comes from: a mesh of its own, or the target as it is before the step.
struct Source {
  Mesh own_mesh;
  Topology own_topology;
  const Mesh* mesh = nullptr;
  const Topology* topology = nullptr;
};

void load_source(const CoatStep& step, const std::filesystem::path& base_directory,
                 const RunResult& result, Source& source) {
  source.mesh = &result.mesh;
  source.topology = &result.topology;
  if (step.source.empty()) return;
  source.own_mesh = read_mesh(base_directory / step.source);
  source.own_topology = build_topology(source.own_mesh);
  source.mesh = &source.own_mesh;
  source.topology = &source.own_topology;
}

Patch patch_of(const RegionSpec& spec, const Mesh& mesh, const Topology& topology) {
  return disk_patch(resolve(spec, mesh, topology), topology, mesh.positions, spec.where);
}

double area(std::span<const Triangle> triangles, std::span<const Vector3d> positions) {
  double twice = 0.0;
  for (const auto& [a, b, c] : triangles) {
    twice += (positions[b] - positions[a]).cross(positions[c] - positions[a]).norm();
  }
  return 0.5 * twice;
}

struct Largest {
  double distance = 0.0;
  Index vertex = kNoIndex;
};

Largest largest_displacement(const Positions& before, const Positions& after) {
  Largest largest;
  for (std::size_t v = 0; v < before.size(); ++v) {
    const double distance = (after[v] - before[v]).norm();
    if (distance > largest.distance) largest = {distance, static_cast<Index>(v)};
  }
  return largest;
}

}  // namespace

StepReport run_step(const CoatStep& step, const std::filesystem::path& base_directory,
                    Kernels& kernels, const Progress& progress, RunResult& result) {
  const CoatParameters& parameters = step.parameters;
  StepReport report;
  report.op = "coat";
  CoatReport& coat = report.coat.emplace();
  Source source;
  stage("source", report.timings, progress,
        [&] { load_source(step, base_directory, result, source); });
  Patch source_patch;
  Patch target_patch;
  stage("patches", report.timings, progress, [&] {
    source_patch = patch_of(step.source_patch, *source.mesh, *source.topology);
    target_patch = patch_of(step.target_patch, result.mesh, result.topology);
  });
  Coating coating;
  stage("peel", report.timings, progress, [&] {
    coating = peel(std::move(source_patch), source.mesh->positions, *source.topology,
                   parameters.detail_size, parameters.weights, kernels);
  });
  const Positions before = result.mesh.positions;
  Positions smooth = before;
  if (parameters.smooth_target > 0.0) {
    stage("smooth_target", report.timings, progress, [&] {
      smooth = smooth_around(target_patch.vertices, parameters.smooth_target, before,
                             result.topology, parameters.weights, "smooth_target");
    });
  }
  // The surfaces below the detail are laid on each other: it has no say in where it comes to.
  Correspondence map;
  const auto placed = on_patch<Vector3d>(target_patch, smooth);
  stage("map", report.timings, progress, [&] {
    map = correspond({coating.patch, coating.smooth}, {target_patch, placed},
                     parameters.correspondence, step.where);
  });

  // How much larger the target patch is: lengths on the source become lengths there.
  const double ratio = std::sqrt(area(target_patch.triangles, placed) /
                                 area(coating.patch.triangles, coating.smooth));
  CoaterOptions options;
  options.weights = parameters.weights;
  options.hold_length = ratio * parameters.detail_size;
  options.transition = parameters.transition.value_or(
      Transition{ratio * parameters.detail_size, Transition::Profile::smooth});
  CoatTarget target{before};
  if (parameters.smooth_target > 0.0) target.smooth = smooth;
  Coater coater(target, result.topology, target_patch, options, kernels, progress);
  coater.take(coating, map.points, parameters.sampling, progress);
  result.mesh.positions = coater.coat(parameters.amplitude);
  for (const auto& [name, ms] : coater.timings().stages()) report.timings.add(name, ms);

  report.roi = target_patch.vertices.size();
  report.free = coater.free().size();
  report.belt = target_patch.loop.size();
  const Largest largest = largest_displacement(before, result.mesh.positions);
  coat.source_vertices = coating.patch.vertices.size();
  coat.pins = map.pins;
  coat.flipped_source = map.flipped_source;
  coat.flipped_target = map.flipped_target;
  coat.warp_steps = map.warp.steps;
  coat.constrained_steps = map.warp.constrained_steps;
  coat.mean_scale = coater.mean_scale();
  coat.transition_width = options.transition.width;
  coat.relative_residual = coater.relative_residual();
  coat.largest_displacement = largest.distance;
  coat.largest_displacement_vertex = largest.vertex;
  return report;
}

}  // namespace lapwing
