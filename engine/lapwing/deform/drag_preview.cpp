#include "lapwing/deform/drag_preview.h"

#include <vector>

#include "lapwing/deform/edit_system.h"

namespace lapwing {

using Eigen::Vector3d;

namespace {

constexpr std::size_t kCoordinates = kMotionParameters / 3;

// How the region follows each coordinate function of handle `h`, as set_axis_basis takes it.
void add_columns(const EditSystem& system, std::size_t h, std::span<double> columns) {
  const HandleFrame& frame = system.frames[h];
  const Positions& rest = *system.rest;
  const LaplacianSystem& laplacian = system.systems->laplacian();
  std::vector<Vector3d> coordinates(rest.size(), Vector3d::Zero());
  std::vector<Vector3d> one(rest.size(), Vector3d::Zero());
  for (const Index v : system.region.handles[h]) {
    coordinates[v] = (rest[v] - frame.centroid) / frame.radius;
    one[v].x() = 1.0;
  }
  const std::size_t n = laplacian.size();
  std::vector<double> x(6 * n);
  laplacian.right_hand_side(coordinates, std::span(x).first(3 * n));
  laplacian.right_hand_side(one, std::span(x).subspan(3 * n));
  laplacian.solve_in_place(std::span(x).first(kCoordinates * n), kCoordinates);

  for (std::size_t k = 0; k < kCoordinates; ++k) {
    double* out = columns.data() + k * system.moving.size();
    for (const Index v : system.moving) {
      const Index u = system.constraints.unknowns.of_vertex[v];
      if (u != kNoIndex) {
        *out++ = x[k * n + u];
      } else {  // of a handle with hard constraints, this one or another
        *out++ = k == 3 ? one[v].x() : coordinates[v][static_cast<Eigen::Index>(k)];
      }
    }
  }
}

}  // namespace

struct DragPreview::State {
  std::shared_ptr<const EditSystem> system;
  StageTimings timings;
  std::vector<double> parameters;
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
      prepared, rest, std::move(region), options, true, progress, [&](const EditSystem& edit) {
        state_->surface =
            kernels.make_surface({*edit.rest, edit.topology, edit.moving, {}, edit.column_count()});
      });
  report_progress(progress, "preview", 0.0);
  const Stopwatch watch;
  const std::size_t handle_columns = system->moving.size() * kCoordinates;
  std::vector<double> columns(handle_columns * system->frames.size());
  {
    const auto lock = system->systems->lock();
    system->hold_laplacian();
    for (std::size_t h = 0; h < system->frames.size(); ++h) {
      add_columns(*system, h, std::span(columns).subspan(h * handle_columns, handle_columns));
    }
  }
  state_->surface->set_axis_basis(columns);
  state_->parameters.resize(system->column_count());
  state_->timings = system->timings;
  state_->timings.add("preview", watch.elapsed_ms());
  state_->system = system;
  report_progress(progress, "preview", 1.0);
}

DragPreview::~DragPreview() = default;
DragPreview::DragPreview(DragPreview&&) noexcept = default;
DragPreview& DragPreview::operator=(DragPreview&&) noexcept = default;

void DragPreview::drag(std::span<const Eigen::Affine3d> motions) {
  state_->system->set_parameters(motions, state_->parameters);
  state_->surface->blend(state_->parameters);
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
