#include "lapwing/deform/drag_preview.h"

#include <algorithm>
#include <vector>

#include "lapwing/deform/axis_response.h"
#include "lapwing/deform/deformer.h"
#include "lapwing/deform/edit_system.h"

namespace lapwing {

using Eigen::Vector3d;

struct DragPreview::State {
  std::shared_ptr<const EditSystem> system;
  StageTimings timings;
  std::vector<double> parameters;
  std::vector<double> base;  ///< parameters of the pose that drags begin from
  std::unique_ptr<DeformedSurface> surface;
};

DragPreview::DragPreview(std::span<const Vector3d> rest, const Topology& topology,
                         EditRegion region, const DeformOptions& options, Kernels& kernels,
                         const Progress& progress) {
  PreparedRegion prepared(topology);
  *this = DragPreview(prepared, rest, std::move(region), options, kernels, progress);
}

DragPreview::DragPreview(PreparedRegion& prepared, std::span<const Vector3d> rest,
                         EditRegion region, const DeformOptions& options, Kernels& kernels,
                         const Progress& progress)
    : state_(std::make_unique<State>()) {
  // The device gets all but the basis while the order is found.
  const auto system = std::make_shared<const EditSystem>(
      prepared, rest, std::move(region), options, progress, [&](const EditSystem& edit) {
        state_->surface =
            kernels.make_surface({*edit.rest, edit.topology, edit.moving, {}, edit.column_count()});
      });
  report_progress(progress, "preview", 0.0);
  const Stopwatch watch;
  {
    const auto lock = system->systems->lock();
    system->hold_laplacian();
    state_->surface->set_axis_basis(axis_response(*system));
  }
  state_->parameters.resize(system->column_count());
  state_->base.resize(system->column_count(), 0.0);
  state_->timings = system->timings;
  state_->timings.add("preview", watch.elapsed_ms());
  state_->system = system;
  report_progress(progress, "preview", 1.0);
}

DragPreview::~DragPreview() = default;
DragPreview::DragPreview(DragPreview&&) noexcept = default;
DragPreview& DragPreview::operator=(DragPreview&&) noexcept = default;

void DragPreview::drag(std::span<const Eigen::Affine3d> motions) {
  State& s = *state_;
  s.system->set_parameters(motions, s.parameters);
  for (std::size_t k = 0; k < s.parameters.size(); ++k) s.parameters[k] -= s.base[k];
  s.surface->blend(s.parameters);
}

void DragPreview::drag_from(const SettledPose& pose) {
  State& s = *state_;
  s.base.assign(s.parameters.size(), 0.0);
  std::copy(pose.parameters.begin(), pose.parameters.end(), s.base.begin());
  Positions from = *s.system->rest;
  if (!pose.displacement.empty()) {
    for (const Index v : s.system->moving) from[v] += pose.displacement[v];
  }
  s.surface->set_rest(from);
}

SettledPose DragPreview::pose_at(std::span<const Vector3d> positions,
                                 std::span<const Eigen::Affine3d> motions,
                                 std::span<const Eigen::AngleAxisd> turns) const {
  const EditSystem& edit = *state_->system;
  SettledPose pose;
  pose.parameters.resize(edit.column_count());
  edit.set_parameters(motions, pose.parameters);
  pose.turns.assign(turns.begin(), turns.end());
  pose.displacement.assign(edit.rest->size(), Vector3d::Zero());
  for (const Index v : edit.moving) pose.displacement[v] = positions[v] - (*edit.rest)[v];
  return pose;
}

DeformedSurface& DragPreview::surface() {
  return *state_->surface;
}
const EditRegion& DragPreview::region() const {
  return state_->system->region;
}
const StageTimings& DragPreview::timings() const {
  return state_->timings;
}
const std::shared_ptr<const EditSystem>& DragPreview::system() const {
  return state_->system;
}

}  // namespace lapwing
