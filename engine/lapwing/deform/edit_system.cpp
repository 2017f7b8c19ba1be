#include "lapwing/deform/edit_system.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "lapwing/base/errors.h"
#include "lapwing/base/parallel.h"

namespace lapwing {
namespace {

using Eigen::Vector3d;

void check(const DeformOptions& options) {
  if (!(options.constraint_weight > 0.0) || !std::isfinite(options.constraint_weight)) {
    throw InputError("the constraint weight must be a positive number, not " +
                     std::to_string(options.constraint_weight));
  }
}

std::vector<Index> moving_vertices(const EditRegion& region, const Unknowns& unknowns) {
  std::vector<Index> moving = unknowns.vertices;
  for (const auto& handle : region.handles) {
    for (const Index v : handle) {
      if (unknowns.of_vertex[v] == kNoIndex) moving.push_back(v);
    }
  }
  std::sort(moving.begin(), moving.end());
  return moving;
}

}  // namespace

EditSystem::EditSystem(std::span<const Vector3d> rest_positions, const Topology& mesh_topology,
                       EditRegion edit_region, const DeformOptions& deform_options,
                       bool with_laplacian, const Progress& progress)
    : rest(rest_positions.begin(), rest_positions.end()),
      topology(mesh_topology),
      region(std::move(edit_region)),
      options(deform_options) {
  check(options);
  report_progress(progress, "pattern", 0.0);
  Stopwatch watch;
  constraints = constraints_of(region, topology, options.constraint_weight, options.hard);
  pattern = std::make_unique<SystemPattern>(topology, region.roi, constraints.unknowns);
  timings.add("pattern", watch.elapsed_ms());
  report_progress(progress, "order", 0.0);
  watch.restart();
  parallel_invoke(
      [&] {
        check_anchors(region, rest, topology, "region");
        for (const auto& handle : region.handles) frames.push_back(handle_frame(handle, rest));
        moving = moving_vertices(region, constraints.unknowns);
      },
      [&] { pattern->order(); });
  timings.add("order", watch.elapsed_ms());
  if (!with_laplacian) return;
  report_progress(progress, "laplacian", 0.0);
  const SettleOptions settle = options.settle.value_or(SettleOptions{.weights = options.weights});
  laplacian = std::make_unique<LaplacianSystem>(rest, topology, region.roi, constraints, *pattern,
                                                settle.weights, settle.stretch_resistance, timings);
}

void EditSystem::set_parameters(std::span<const Eigen::Affine3d> motions,
                                std::span<double> parameters) const {
  if (motions.size() != frames.size()) {
    throw InputError("the region has " + std::to_string(frames.size()) + " handles, but " +
                     std::to_string(motions.size()) + " motions were given; give one per handle");
  }
  for (std::size_t h = 0; h < frames.size(); ++h) {
    motion_parameters(frames[h], motions[h],
                      parameters.subspan(h * kMotionParameters, kMotionParameters));
  }
}

std::vector<Vector3d> EditSystem::wanted_displacement(std::span<const double> parameters) const {
  std::vector<Vector3d> wanted(rest.size(), Vector3d::Zero());
  for (std::size_t h = 0; h < frames.size(); ++h) {
    const auto own = parameters.subspan(h * kMotionParameters, kMotionParameters);
    for (const Index v : region.handles[h]) {
      for (std::size_t k = 0; k < kMotionParameters; ++k) {
        wanted[v] += own[k] * unit_displacement(frames[h], rest[v], k);
      }
    }
  }
  return wanted;
}

}  // namespace lapwing
