#include "lapwing/deform/dragged_surface.h"

#include <algorithm>

namespace lapwing {

using Eigen::Vector3d;

DraggedSurface::DraggedSurface(std::shared_ptr<const EditSystem> system,
                               std::unique_ptr<DeformedSurface> surface)
    : system_(std::move(system)),
      surface_(std::move(surface)),
      parameters_(system_->column_count()),
      base_(system_->column_count(), 0.0) {}

void DraggedSurface::drag(std::span<const Eigen::Affine3d> motions) {
  system_->set_parameters(motions, parameters_);
  for (std::size_t k = 0; k < parameters_.size(); ++k) parameters_[k] -= base_[k];
  surface_->blend(parameters_);
}

void DraggedSurface::drag_from(const SettledPose& pose) {
  base_.assign(parameters_.size(), 0.0);
  std::copy(pose.parameters.begin(), pose.parameters.end(), base_.begin());
  Positions from = *system_->rest;
  if (!pose.displacement.empty()) {
    for (const Index v : system_->moving) from[v] += pose.displacement[v];
  }
  surface_->set_rest(from);
}

SettledPose pose_at(const EditSystem& system, std::span<const Vector3d> positions,
                    std::span<const Eigen::Affine3d> motions,
                    std::span<const Eigen::AngleAxisd> turns) {
  SettledPose pose;
  pose.parameters.resize(system.column_count());
  system.set_parameters(motions, pose.parameters);
  pose.turns.assign(turns.begin(), turns.end());
  pose.displacement.assign(system.rest->size(), Vector3d::Zero());
  for (const Index v : system.moving) pose.displacement[v] = positions[v] - (*system.rest)[v];
  return pose;
}

}  // namespace lapwing
