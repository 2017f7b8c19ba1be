#include "lapwing/deform/drag_preview.h"

#include "lapwing/base/cancellation.h"
#include "lapwing/deform/edit_system.h"
#include "lapwing/deform/linear_response.h"

namespace lapwing {

using Eigen::Vector3d;

DragPreview::DragPreview(std::span<const Vector3d> rest, const Topology& topology,
                         EditRegion region, const DeformOptions& options,
                         const Progress& progress) {
  PreparedRegion prepared(topology);
  *this = DragPreview(prepared, rest, std::move(region), options, {}, progress);
}

DragPreview::DragPreview(PreparedRegion& prepared, std::span<const Vector3d> rest,
                         EditRegion region, const DeformOptions& options,
                         std::optional<std::span<const std::size_t>> handles,
                         const Progress& progress)
    : DragPreview(std::make_shared<const EditSystem>(prepared, rest, std::move(region), options,
                                                     progress, true),
                  handles, progress) {}

DragPreview::DragPreview(std::shared_ptr<const EditSystem> system,
                         std::optional<std::span<const std::size_t>> handles,
                         const Progress& progress)
    : system_(std::move(system)), timings_(system_->timings) {
  const ProgressScope scope(progress);
  report_progress(progress, "preview", 0.0);
  const Stopwatch watch;
  response_ = handles ? response_of(*handles) : response_of(system_->all_handles());
  timings_.add("preview", watch.elapsed_ms());
  report_progress(progress, "preview", 1.0);
}

std::shared_ptr<const DragResponse> DragPreview::response_of(
    std::span<const std::size_t> handles) const {
  std::vector<std::size_t> dragged = in_order(handles);
  Numbers columns = laplacian_response(*system_, dragged);
  return std::make_shared<const DragResponse>(system_, std::move(dragged), std::move(columns),
                                              true);
}

const EditRegion& DragPreview::region() const {
  return system_->region;
}

}  // namespace lapwing
