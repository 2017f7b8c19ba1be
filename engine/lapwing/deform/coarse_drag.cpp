#include "lapwing/deform/coarse_drag.h"

#include <algorithm>
#include <utility>

#include "lapwing/base/stopwatch.h"
#include "lapwing/deform/axis_response.h"
#include "lapwing/deform/recent_change.h"

namespace lapwing {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

// Vertices of the coarse region. Fewer follow limbs worse; more take longer (README).
constexpr std::size_t kCoarseVertices = 3500;

// Of what the surface did recently: less than all of it, since recent frames have left something.
constexpr double kTrustInRecent = 0.9;

// Of the gathered forces: the coarse surface gives way to them a little more or less than the fine
// one would.
constexpr double kTrustInForces = 0.7;

}  // namespace

std::unique_ptr<CoarseDrag> CoarseDrag::make(const EditSystem& fine) {
  if (!fine.needs_coarse_surface()) return nullptr;
  std::unique_ptr<CoarseRegion> coarse = coarse_region(fine, kCoarseVertices);
  if (coarse == nullptr) return nullptr;
  return std::unique_ptr<CoarseDrag>(new CoarseDrag(fine, std::move(coarse)));
}

CoarseDrag::CoarseDrag(const EditSystem& fine, std::unique_ptr<CoarseRegion> coarse)
    : coarse_(std::move(coarse)),
      settler_(kernels_, *coarse_->edit->laplacian, *fine.options.settle),
      energy_ratio_(static_cast<double>(coarse_->edit->region.roi.size()) /
                    static_cast<double>(fine.region.roi.size())),
      is_held_(surface().kept.size(), 1),
      coarse_of_(places_in(surface().kept, fine.rest->size())) {
  for (const Index c : coarse_->edit->region.roi) is_held_[c] = 0;
  for (const Index c : coarse_->edit->region.belt) is_held_[c] = 1;
  for (const VertexSet& handle : coarse_->edit->region.handles) {
    for (const Index c : handle) is_held_[c] = 1;
  }
}

std::vector<Vector3d> CoarseDrag::of_kept(std::span<const Vector3d> of_fine) const {
  std::vector<Vector3d> own;
  own.reserve(surface().kept.size());
  for (const Index v : surface().kept) own.push_back(of_fine[v]);
  return own;
}

SettleTarget CoarseDrag::target_of(const SettleTarget& fine) {
  next_wanted_ = of_kept(fine.wanted);
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
  return {next_wanted_, stretch_, forces_, free_handles_};
}

// Of the surface that was settled or asked for its energy last.
CoarseEmbedding::Pose CoarseDrag::pose_at(std::vector<Vector3d> displacement) {
  const RegionRings& rings = coarse_->edit->laplacian->rings();
  CoarseEmbedding::Pose pose{std::move(displacement),
                             std::vector<Matrix3d>(surface().kept.size(), Matrix3d::Identity())};
  const std::vector<Matrix3d> transforms = settler_.transforms();
  for (std::size_t r = 0; r < rings.row_count(); ++r) {
    pose.transforms[rings.vertices[r]] = transforms[r];
  }
  return pose;
}

void CoarseDrag::begin(const SettleTarget& target, std::span<const Vector3d> u) {
  forces_.assign(surface().kept.size(), Vector3d::Zero());
  recent_wanted_.clear();
  recent_displacement_.clear();
  settler_.begin_drag();
  std::vector<Vector3d> displacement = of_kept(u);
  settler_.energy(target_of(target), displacement);
  pose_ = pose_at(std::move(displacement));
  wanted_ = next_wanted_;
}

// Where the surface is for the next target: as far as the handles go on as they did recently, so
// does the surface, and the rest of the way it responds linearly.
std::vector<Vector3d> CoarseDrag::gone_on() const {
  std::vector<Vector3d> displacement = pose_.displacement;
  if (wanted_ == next_wanted_) return displacement;
  std::vector<Vector3d> change = next_wanted_;
  ShareOfRecent again;
  for (std::size_t c = 0; c < change.size(); ++c) {
    change[c] -= wanted_[c];
    if (!recent_wanted_.empty()) again.add(change[c], recent_wanted_[c]);
  }
  if (const double share = kTrustInRecent * again.value(); share > 0.0) {
    for (std::size_t c = 0; c < change.size(); ++c) {
      change[c] -= share * recent_wanted_[c];
      displacement[c] += share * recent_displacement_[c];
    }
  }
  const std::vector<Vector3d> response = axis_displacement(*coarse_->edit, change, Springs::rest);
  for (std::size_t c = 0; c < change.size(); ++c) displacement[c] += response[c];
  return displacement;
}

void CoarseDrag::move(const SettleTarget& target, const GoOn& go_on, double next_ms,
                      std::span<Vector3d> u) {
  const SettleTarget own = target_of(target);
  std::vector<Vector3d> displacement = gone_on();
  int iterations = 0;
  // One more takes no time that the caller has a use for.
  const auto has_time = [&](double ms) {
    if (iterations < kFewestIterations || !go_on || go_on(ms + carrying_ms_ + next_ms)) return true;
    return !go_on(carrying_ms_ + next_ms) && go_on(ms + carrying_ms_);
  };
  settler_.follow(own, displacement, [&](double ms) {
    return iterations < kMostIterations && has_time(ms) && ++iterations > 0;
  });
  const Stopwatch carrying;
  carry_to(std::move(displacement), u);
  carrying_ms_ = carrying.elapsed_ms();
}

void CoarseDrag::settle(const SettleTarget& target, const Progress& progress,
                        std::span<Vector3d> u) {
  const SettleTarget own = target_of(target);
  std::vector<Vector3d> displacement = gone_on();
  settler_.settle(own, displacement, progress);
  carry_to(std::move(displacement), u);
}

// The coarse surface is at `displacement`, for the next target: takes the fine one along.
void CoarseDrag::carry_to(std::vector<Vector3d> displacement, std::span<Vector3d> u) {
  CoarseEmbedding::Pose next = pose_at(std::move(displacement));
  coarse_->level->embedding.carry(pose_, next, u);
  if (wanted_ != next_wanted_) {
    add_change(recent_wanted_, wanted_, next_wanted_);
    add_change(recent_displacement_, pose_.displacement, next.displacement);
  }
  pose_ = std::move(next);
  std::swap(wanted_, next_wanted_);
}

void CoarseDrag::learn(std::span<const Vector3d> u, std::span<const Vector3d> gradient) {
  const std::vector<Vector3d> gathered = coarse_->level->embedding.gather(gradient, u, pose_);
  for (std::size_t c = 0; c < gathered.size(); ++c) {
    if (is_held_[c] == 0) forces_[c] -= kTrustInForces * energy_ratio_ * gathered[c];
  }
}

}  // namespace lapwing
