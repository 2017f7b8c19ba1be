#include "lapwing/deform/drag_preview.h"

#include <optional>

#include "lapwing/deform/axis_response.h"
#include "lapwing/deform/dragged_surface.h"
#include "lapwing/deform/edit_system.h"

namespace lapwing {

using Eigen::Vector3d;

struct DragPreview::State {
  std::shared_ptr<const EditSystem> system;
  StageTimings timings;
  std::optional<DraggedSurface> surface;  ///< from the end of the preparation on
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
  std::unique_ptr<DeformedSurface> surface;
  // The device gets all but the basis while the order is found.
  const auto system = std::make_shared<const EditSystem>(
      prepared, rest, std::move(region), options, progress, [&](const EditSystem& edit) {
        surface =
            kernels.make_surface({*edit.rest, edit.topology, edit.moving, {}, edit.column_count()});
      });
  report_progress(progress, "preview", 0.0);
  const Stopwatch watch;
  {
    const auto lock = system->systems->lock();
    system->hold_laplacian();
    surface->set_axis_basis(axis_response(*system));
  }
  state_->surface.emplace(system, std::move(surface));
  state_->timings = system->timings;
  state_->timings.add("preview", watch.elapsed_ms());
  state_->system = system;
  report_progress(progress, "preview", 1.0);
}

DragPreview::~DragPreview() = default;
DragPreview::DragPreview(DragPreview&&) noexcept = default;
DragPreview& DragPreview::operator=(DragPreview&&) noexcept = default;

void DragPreview::drag(std::span<const Eigen::Affine3d> motions) {
  state_->surface->drag(motions);
}

void DragPreview::drag_from(const SettledPose& pose) {
  state_->surface->drag_from(pose);
}

SettledPose DragPreview::pose_at(std::span<const Vector3d> positions,
                                 std::span<const Eigen::Affine3d> motions,
                                 std::span<const Eigen::AngleAxisd> turns) const {
  return lapwing::pose_at(*state_->system, positions, motions, turns);
}

DeformedSurface& DragPreview::surface() {
  return state_->surface->surface();
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
