#include "lapwing/deform/drag.h"

#include <algorithm>
#include <utility>

#include "lapwing/deform/edit_system.h"
#include "lapwing/kernels/cpu_kernels.h"

namespace lapwing {

using Eigen::Vector3d;

DragResponse::DragResponse(std::shared_ptr<const EditSystem> system,
                           std::vector<std::size_t> handles, Numbers numbers, bool along_axes,
                           std::string why_not_exact)
    : system_(std::move(system)),
      handles_(std::move(handles)),
      numbers_(std::move(numbers)),
      along_axes_(along_axes),
      why_not_exact_(std::move(why_not_exact)) {}

const Positions& DragResponse::rest() const {
  return *system_->rest;
}
const Topology& DragResponse::topology() const {
  return system_->topology;
}
ResponseColumns DragResponse::columns() const {
  return {system_->moving, kMotionParameters * handles_.size(), numbers_, along_axes_};
}

void DragResponse::set_parameters(std::span<const Eigen::Affine3d> motions,
                                  std::span<double> parameters) const {
  system_->set_parameters(motions, handles_, parameters);
}

DragState DragResponse::pose_at(std::span<const Vector3d> positions, HandleMotions motions) const {
  DragState pose;
  pose.motions = std::move(motions);
  pose.displacement.assign(rest().size(), Vector3d::Zero());
  for (const Index v : system_->moving) pose.displacement[v] = positions[v] - rest()[v];
  return pose;
}

std::vector<std::size_t> in_order(std::span<const std::size_t> handles) {
  std::vector<std::size_t> ordered(handles.begin(), handles.end());
  std::sort(ordered.begin(), ordered.end());
  ordered.erase(std::unique(ordered.begin(), ordered.end()), ordered.end());
  return ordered;
}

Drag::Drag(std::shared_ptr<const DragResponse> response, std::shared_ptr<const DragState> pose)
    : response_(std::move(response)),
      pose_(std::move(pose)),
      of_pose_(response_->columns().count, 0.0),
      parameters_(response_->columns().count) {
  if (pose_ && !pose_->empty()) response_->set_parameters(pose_->motions.maps, of_pose_);
}

std::span<const double> Drag::parameters(std::span<const Eigen::Affine3d> motions) {
  response_->set_parameters(motions, parameters_);
  for (std::size_t k = 0; k < of_pose_.size(); ++k) parameters_[k] -= of_pose_[k];
  return parameters_;
}

void Drag::move(std::span<const Eigen::Affine3d> motions, std::span<Vector3d> positions) {
  const ResponseColumns columns = response_->columns();
  const Positions& rest = response_->rest();
  if (!pose_ || pose_->displacement.empty()) {
    return blend_response(rest, columns, parameters(motions), positions);
  }
  for (const Index v : columns.moving) positions[v] = rest[v] + pose_->displacement[v];
  blend_response(positions, columns, parameters(motions), positions);
}

}  // namespace lapwing
