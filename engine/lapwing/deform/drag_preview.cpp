#include "lapwing/deform/drag_preview.h"

#include "lapwing/deform/axis_response.h"
#include "lapwing/deform/edit_system.h"

namespace lapwing {

using Eigen::Vector3d;

DragPreview::DragPreview(std::span<const Vector3d> rest, const Topology& topology,
                         EditRegion region, const DeformOptions& options,
                         const Progress& progress) {
  PreparedRegion prepared(topology);
  *this = DragPreview(prepared, rest, std::move(region), options, progress);
}

DragPreview::DragPreview(PreparedRegion& prepared, std::span<const Vector3d> rest,
                         EditRegion region, const DeformOptions& options, const Progress& progress)
    : system_(
          std::make_shared<const EditSystem>(prepared, rest, std::move(region), options, progress)),
      timings_(system_->timings) {
  report_progress(progress, "preview", 0.0);
  const Stopwatch watch;
  const auto lock = system_->systems->lock();
  system_->hold_laplacian();
  response_ = std::make_shared<const DragResponse>(system_, axis_response(*system_), true);
  timings_.add("preview", watch.elapsed_ms());
  report_progress(progress, "preview", 1.0);
}

const EditRegion& DragPreview::region() const {
  return system_->region;
}

}  // namespace lapwing
