#include "lapwing/deform/edit_system.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <sstream>
#include <string>

#include "lapwing/base/cancellation.h"
#include "lapwing/base/errors.h"
#include "lapwing/base/limits.h"
#include "lapwing/base/parallel.h"
#include "lapwing/mesh/mesh.h"

namespace lapwing {
namespace {

using Eigen::Vector3d;

// Memory per vertex, in bytes, for its rows, its packed ring, the L-BFGS history and temporary data
// of the preparation, without mesh and factor. Measured for 0.1 and 0.4 million vertices.
constexpr std::size_t kBytesToSettle = 3100;

// Drags of regions with fewer vertices need no coarse surface.
constexpr std::size_t kSmallRegion = 6500;

void check(const DeformOptions& options, const EditRegion& region) {
  std::ostringstream text;
  if (!(options.detail_length >= kLeastDetailLength &&
        options.detail_length <= kMostDetailLength)) {
    text << "the detail length must be a number from " << kLeastDetailLength << " to "
         << kMostDetailLength << ", not " << options.detail_length;
    throw InputError(text.str());
  }
  if (options.constraint_weight && !is_weight(*options.constraint_weight)) {
    text << "the constraint weight must be " << kWeightWords << ", not "
         << *options.constraint_weight;
    throw InputError(text.str());
  }
  if (!region.stiffness.empty() && !options.settle && options.response == LinearResponse::rsi) {
    throw InputError(
        "the paper's linear system does not support stiffness. Remove \"stiffness\", turn on "
        "\"settle\", or "
        "set \"response\" to \"tangent\"");
  }
}

double extent_of(const VertexSet& roi, const Topology& topology, std::span<const Vector3d> rest) {
  std::vector<Index> attached;
  std::copy_if(roi.begin(), roi.end(), std::back_inserter(attached),
               [&](Index v) { return !topology.rings[v].empty(); });
  return require_extent(with_ring_neighbours(attached, topology.rings), rest, "region");
}

// Throws an error if a vertex has so many neighbours that the matrix would become dense, because a
// ring couples every pair of its vertices. Such a vertex appears when a polygon with many corners
// is triangulated as a fan around one corner.
void require_sparse(const VertexSet& roi, const Topology& topology) {
  constexpr std::size_t kFewNeighbours = 1000;
  constexpr double kBytesOfPair = sizeof(double) + sizeof(Index);
  double bytes = 0.0;
  Index hub = roi.front();
  for (const Index v : roi) {
    const std::size_t neighbours = topology.rings[v].size();
    if (neighbours <= kFewNeighbours) continue;
    bytes += kBytesOfPair * 0.5 * static_cast<double>(neighbours) * static_cast<double>(neighbours);
    if (neighbours > topology.rings[hub].size()) hub = v;
  }
  require_memory(static_cast<std::size_t>(bytes),
                 "the matrix of the region, in which vertex " + std::to_string(hub) + " has " +
                     std::to_string(topology.rings[hub].size()) + " neighbours,",
                 "remesh the largest polygons, or keep the region away from them");
}

std::vector<Index> moving_vertices(const EditRegion& region, const Unknowns& unknowns) {
  std::vector<Index> moving = unknowns.vertices;
  for (const auto& handle : region.handles) {
    for (const Index v : handle) {
      if (unknowns.of_vertex[v] == kNoIndex) moving.push_back(v);
    }
  }
  for (const Target& target : region.targets) {
    const Index v = target.corners[0];
    if (target.is_vertex() && unknowns.of_vertex[v] == kNoIndex) moving.push_back(v);
  }
  for (const LoosePart& part : region.loose) {
    moving.insert(moving.end(), part.vertices.begin(), part.vertices.end());
  }
  std::sort(moving.begin(), moving.end());
  return moving;
}

}  // namespace

EditSystem::EditSystem(PreparedRegion& prepared, std::span<const Vector3d> rest_positions,
                       EditRegion edit_region, const DeformOptions& deform_options,
                       const Progress& progress, bool is_previewed)
    : topology(prepared.topology()), region(std::move(edit_region)), options(deform_options) {
  check(options, region);
  const ProgressScope scope(progress);
  size = extent_of(region.roi, topology, rest_positions);
  Stopwatch watch;
  const auto begin = [&](const char* stage) {
    report_progress(progress, stage, 0.0);
    return stage;
  };
  constraints = constraints_of(region, topology, options.constraint_weight, options.hard);
  rest = prepared.copy_of(rest_positions);
  make_springs();
  const bool finds_pattern = !prepared.serves(region.roi, constraints.unknowns);
  if (finds_pattern) {
    begin("pattern");
    require_sparse(region.roi, topology);
  }
  factors = prepared.factors_of(region.roi, constraints.unknowns);
  if (finds_pattern) {
    timings.add("pattern", watch.elapsed_ms());
    watch.restart();
  }
  FactorCache::LaplacianBuild build = factors->build_laplacian(terms(), constraints.W);
  const char* const stage = begin(build.is_ordered() ? "constraints" : "order");
  const auto assemble = [&] {
    check_and_frame();
    build.assemble();
  };
  if (build.is_analyzed()) {
    assemble();  // on all threads
  } else {
    parallel_invoke(assemble, [&] { build.analyze(); });
  }
  // Without a preview, no drag waits for this constructor, and the next step factorizes a 3n x 3n
  // system.
  if (!is_previewed) build.analyze_hessian();
  timings.add(stage, watch.elapsed_ms());
  watch.restart();
  if (finds_pattern) require_memory_to_settle(build.factor_bytes());
  begin("laplacian");
  laplacian = build.finish();
  timings.add("laplacian", watch.elapsed_ms());
}

bool EditSystem::needs_coarse_surface() const {
  return options.settle && region.roi.size() >= kSmallRegion;
}

// Checks the minimum memory for settling, without the 3n x 3n system. Only a new cache needs this
// check: an existing cache has already allocated this memory.
void EditSystem::require_memory_to_settle(std::size_t factor_bytes) const {
  if (!options.settle) return;
  require_memory(factor_bytes + kBytesToSettle * region.roi.size(),
                 "settling " + std::to_string(region.roi.size()) + " vertices",
                 "choose a smaller region");
}

void EditSystem::check_and_frame() {
  check_anchors(region, *rest, topology, "region");
  for (const auto& handle : region.handles) frames.push_back(handle_frame(handle, *rest));
  loose = LooseParts(region, *rest, topology);
  moving = moving_vertices(region, constraints.unknowns);
}

void EditSystem::make_springs() {
  std::vector<Spring> made;
  for (std::size_t t = 0; t < region.targets.size(); ++t) {
    const Target& target = region.targets[t];
    require_near((target.position - point_of(target, *rest)).norm(), "target", t);
    if (region.hard_targets && target.is_vertex()) continue;
    const double weight = target.weight * options.constraint_weight.value_or(1.0);
    made.push_back({target.corners, target.shares, target.position - point_of(target, *rest),
                    region.hard_targets ? kStiff : weight * weight});
  }
  if (!made.empty()) springs = std::make_shared<const std::vector<Spring>>(std::move(made));
}

SystemTerms EditSystem::terms() const {
  return {rest,
          {options.weights, options.detail_length, region.stiffness},
          region.turns_freely,
          springs};
}

std::shared_ptr<const BlockRows> EditSystem::tangent_rows(Kernels& kernels) const {
  return factors->tangent_rows(terms(), *laplacian, kernels);
}

std::shared_ptr<const ResponseSystem> EditSystem::response(Kernels& kernels,
                                                           const Progress& progress,
                                                           StageTimings& stages) const {
  return factors->response(terms(), laplacian, options, kernels, progress, stages);
}

// `number` is the index among all handles or targets. This check accepts NaN, which `require_valid`
// rejects later.
void EditSystem::require_near(double distance, const char* what, std::size_t number) const {
  if (size == 0.0 || !(distance > kFarthestMove * size)) return;
  std::ostringstream text;
  text << what << ' ' << number << " moves " << distance << ", over " << kFarthestMove
       << " times the region's size (" << size
       << "). Coordinates that large lose the surface's shape. Move it less, or move the whole "
          "mesh";
  throw InputError(text.str());
}

void EditSystem::require_motions(std::size_t count) const {
  if (count == frames.size()) return;
  throw InputError("the region has " + std::to_string(frames.size()) + " handles, but " +
                   std::to_string(count) + " motions were given; give one per handle");
}

void EditSystem::set_parameters(std::size_t handle, const Eigen::Affine3d& motion,
                                std::span<double> parameters) const {
  motion_parameters(frames[handle], motion, parameters);
  const HandleFrame& frame = frames[handle];
  for (std::size_t k = 0; k < kMotionParameters; ++k) {
    // The linear part does not move a handle of one vertex.
    const double share = k % 4 == 3 ? 1.0 : frame.extent / frame.radius;
    require_near(share * std::abs(parameters[k]), "handle", handle);
  }
}

void EditSystem::set_parameters(std::span<const Eigen::Affine3d> motions,
                                std::span<double> parameters) const {
  require_motions(motions.size());
  for (std::size_t h = 0; h < frames.size(); ++h) {
    set_parameters(h, motions[h], parameters.subspan(h * kMotionParameters, kMotionParameters));
  }
}

void EditSystem::set_parameters(std::span<const Eigen::Affine3d> motions,
                                std::span<const std::size_t> handles,
                                std::span<double> parameters) const {
  require_motions(motions.size());
  for (std::size_t k = 0; k < handles.size(); ++k) {
    set_parameters(handles[k], motions[handles[k]],
                   parameters.subspan(k * kMotionParameters, kMotionParameters));
  }
}

bool EditSystem::is_held_by_handles_alone() const {
  if (!region.belt.empty() || !region.targets.empty()) return false;
  const std::vector<char> in_roi = vertex_mask(rest->size(), region.roi);
  return std::ranges::all_of(region.roi, [&](Index v) {
    const auto ring = topology.rings[v];
    return std::ranges::all_of(ring, [&](Index j) { return in_roi[j] != 0; });
  });
}

std::vector<std::size_t> EditSystem::all_handles() const {
  std::vector<std::size_t> all(frames.size());
  std::iota(all.begin(), all.end(), std::size_t{0});
  return all;
}

std::vector<Vector3d> EditSystem::displacement_of_handles(std::span<const double> parameters,
                                                          std::vector<Vector3d> reused) const {
  reused.resize(rest->size(), Vector3d::Zero());
  for_prescribed([&](std::size_t, Index v) { reused[v].setZero(); });
  for_prescribed([&](std::size_t h, Index v) {
    const auto own = parameters.subspan(h * kMotionParameters, kMotionParameters);
    reused[v] += handle_displacement(frames[h], own, (*rest)[v]);
  });
  return reused;
}

std::vector<Vector3d> EditSystem::prescribed_displacement(std::span<const double> parameters,
                                                          std::vector<Vector3d> reused) const {
  std::vector<Vector3d> prescribed = displacement_of_handles(parameters, std::move(reused));
  for (const Target& target : region.targets) {
    const Index v = target.corners[0];
    if (!target.is_vertex() || constraints.unknowns.of_vertex[v] != kNoIndex) continue;
    prescribed[v] = target.position - (*rest)[v];
  }
  for (const LoosePart& part : region.loose) {
    for (const LooseAnchor& anchor : part.anchors) {
      if (anchor.handle == frames.size()) prescribed[anchor.vertex] = anchor.displacement;
    }
  }
  return prescribed;
}

}  // namespace lapwing
