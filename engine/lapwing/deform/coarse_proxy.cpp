#include "lapwing/deform/coarse_proxy.h"

#include <algorithm>
#include <utility>

#include "lapwing/base/errors.h"
#include "lapwing/base/stopwatch.h"

namespace lapwing {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

// Number of vertices of the coarse region. With fewer vertices, limbs follow less accurately; with
// more, frames take longer (decision 7).
constexpr std::size_t kCoarseVertices = 3500;

}  // namespace

std::unique_ptr<CoarseRegion> coarse_region(const EditSystem& fine, std::size_t count) {
  auto coarse = std::make_unique<CoarseRegion>();
  coarse->level = fine.factors->coarse_surfaces().of(fine.region, fine.topology, fine.rest, count);
  if (coarse->level == nullptr) return nullptr;
  const CoarseSurface& surface = coarse->level->surface;
  try {
    const std::scoped_lock lock(coarse->level->preparing);
    coarse->edit = std::make_unique<const EditSystem>(
        coarse->level->prepared, surface.rest,
        coarse_region_of(fine.region, inverse_index(surface.kept, fine.rest->size())), fine.options,
        Progress(), true);
  } catch (const InputError&) {
    return nullptr;
  } catch (const SolverError&) {
    return nullptr;
  }
  return coarse;
}

std::unique_ptr<CoarseProxy> CoarseProxy::make(const EditSystem& fine) {
  if (!fine.needs_coarse_surface()) return nullptr;
  std::unique_ptr<CoarseRegion> coarse = coarse_region(fine, kCoarseVertices);
  if (coarse == nullptr) return nullptr;
  std::unique_ptr<CoarseProxy> proxy(new CoarseProxy(fine, std::move(coarse)));
  proxy->workspace_.hessian.prepare();
  return proxy;
}

CoarseProxy::CoarseProxy(const EditSystem& fine, std::unique_ptr<CoarseRegion> coarse)
    : coarse_(std::move(coarse)),
      workspace_(*coarse_->edit, kernels_),
      energy_ratio_(static_cast<double>(coarse_->edit->region.roi.size()) /
                    static_cast<double>(fine.region.roi.size())),
      is_held_(surface().kept.size(), 1),
      coarse_of_(inverse_index(surface().kept, fine.rest->size())) {
  for (const Index c : coarse_->edit->region.roi) is_held_[c] = 0;
  for (const Index c : coarse_->edit->region.belt) is_held_[c] = 1;
  for (const VertexSet& handle : coarse_->edit->region.handles) {
    for (const Index c : handle) is_held_[c] = 1;
  }
}

std::vector<Vector3d> CoarseProxy::restricted(std::span<const Vector3d> of_fine) const {
  std::vector<Vector3d> own;
  own.reserve(surface().kept.size());
  for (const Index v : surface().kept) own.push_back(of_fine[v]);
  return own;
}

MinimizerTarget CoarseProxy::target_of(const MinimizerTarget& fine) {
  next_prescribed_ = restricted(fine.prescribed);
  stretch_.clear();
  if (!fine.rest_stretch.empty()) {
    for (const Index v : surface().kept) stretch_.push_back(fine.rest_stretch[v]);
  }
  const Unknowns& unknowns = coarse_->edit->constraints.unknowns;
  free_handles_.clear();
  for (const FreeHandle& handle : fine.free_handles) {
    FreeHandle& own = free_handles_.emplace_back();
    for (std::size_t k = 0; k < handle.vertices.size(); ++k) {
      const Index c = coarse_of_[handle.vertices[k]];
      if (c == kNoIndex || unknowns.of_vertex[c] == kNoIndex) continue;
      own.vertices.push_back(c);
      own.shape.push_back(handle.shape[k]);
      own.to_centre.push_back(handle.to_centre[k]);
    }
  }
  return {next_prescribed_, stretch_, forces_, free_handles_};
}

// Returns a pose with the transforms of the last evaluated surface.
CoarseEmbedding::Pose CoarseProxy::pose_at(std::vector<Vector3d> displacement) {
  const RegionRings& rings = coarse_->edit->laplacian->rings();
  CoarseEmbedding::Pose pose{std::move(displacement),
                             std::vector<Matrix3d>(surface().kept.size(), Matrix3d::Identity())};
  const std::vector<Matrix3d> transforms = minimizer_.transforms();
  for (std::size_t r = 0; r < rings.row_count(); ++r) {
    pose.transforms[rings.vertices[r]] = transforms[r];
  }
  return pose;
}

void CoarseProxy::begin(const MinimizerTarget& target, std::span<const Vector3d> u) {
  forces_.assign(surface().kept.size(), Vector3d::Zero());
  predictor_.clear();
  last_step_ = 0.0;
  minimizer_.begin_drag();
  std::vector<Vector3d> displacement = restricted(u);
  minimizer_.energy(target_of(target), displacement);
  pose_ = pose_at(std::move(displacement));
  prescribed_ = next_prescribed_;
}

std::vector<Vector3d> CoarseProxy::predicted() const {
  if (prescribed_ == next_prescribed_) return pose_.displacement;
  return predictor_.predict(*coarse_->edit, prescribed_, next_prescribed_, pose_.displacement);
}

// Returns the displacements of the proxy in the next frame.
std::vector<Vector3d> CoarseProxy::minimized(const MinimizerTarget& target,
                                             const TimeBudget& budget, double next_ms) {
  const MinimizerTarget own = target_of(target);
  std::vector<Vector3d> displacement = predicted();
  int iterations = 0;
  // Returns true if enough time remains for the caller after another iteration.
  const auto has_time = [&](double ms) {
    if (iterations < kFewestIterations || !budget || budget(ms + prolongation_ms_ + next_ms))
      return true;
    return !budget(prolongation_ms_ + next_ms) && budget(ms + prolongation_ms_);
  };
  const auto goes_on = [&](double ms) {
    return iterations < kMostIterations && has_time(ms) && ++iterations > 0;
  };
  const MinimizerResult result = last_step_ > kLongStep
                                     ? minimizer_.follow_by_hessian(own, displacement, goes_on)
                                     : minimizer_.follow(own, displacement, goes_on);
  last_step_ = result.last_step;
  return displacement;
}

void CoarseProxy::step(const MinimizerTarget& target, const TimeBudget& budget, double next_ms,
                       std::span<Vector3d> u) {
  std::vector<Vector3d> displacement = minimized(target, budget, next_ms);
  const Stopwatch watch;
  embedding().prolongate(move_to(std::move(displacement)), u);
  prolongation_ms_ = watch.elapsed_ms();
}

std::vector<RowsOfMotion> CoarseProxy::step(const MinimizerTarget& target) {
  return move_to(minimized(target, {}, 0.0));
}

void CoarseProxy::settle(const MinimizerTarget& target, const Progress& progress,
                         std::span<Vector3d> u) {
  const MinimizerTarget own = target_of(target);
  std::vector<Vector3d> displacement = predicted();
  minimizer_.settle(own, displacement, progress);
  embedding().prolongate(move_to(std::move(displacement)), u);
}

// Moves the proxy to `displacement`, which belongs to the next target. Returns the motions.
std::vector<RowsOfMotion> CoarseProxy::move_to(std::vector<Vector3d> displacement) {
  CoarseEmbedding::Pose next = pose_at(std::move(displacement));
  std::vector<RowsOfMotion> motions = embedding().motions(pose_, next);
  if (prescribed_ != next_prescribed_) {
    predictor_.add_frame(*coarse_->edit, prescribed_, next_prescribed_, pose_.displacement,
                         next.displacement);
  }
  pose_ = std::move(next);
  std::swap(prescribed_, next_prescribed_);
  return motions;
}

void CoarseProxy::correct(std::span<const Vector3d> u, std::span<const Vector3d> gradient) {
  const std::vector<Vector3d> restricted_forces = embedding().restrict_forces(gradient, u, pose_);
  for (std::size_t c = 0; c < restricted_forces.size(); ++c) {
    if (is_held_[c] == 0) forces_[c] -= energy_ratio_ * restricted_forces[c];
  }
}

}  // namespace lapwing
