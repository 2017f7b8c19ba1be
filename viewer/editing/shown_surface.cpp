#include "editing/shown_surface.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace lapwing::viewer {
namespace {

// Returns the middle of the pixel, which is what a picture shows.
Eigen::Vector2d middle_of(const Eigen::Vector2d& pixel) {
  return {std::floor(pixel.x()) + 0.5, std::floor(pixel.y()) + 0.5};
}

}  // namespace

std::optional<Index> SurfacePicker::triangle_at(const Eigen::Vector2d& pixel) const {
  const bool inside =
      view_ && (pixel.array() >= 0.0).all() && (pixel.array() < view_->size.array().floor()).all();
  if (!inside) return {};
  const auto column = static_cast<std::size_t>(pixel.x());
  const auto row = static_cast<std::size_t>(pixel.y());
  const std::uint32_t id = picture_.ids()[row * static_cast<std::size_t>(view_->size.x()) + column];
  if (id == 0) return {};
  return id - 1;
}

TrianglePicture SurfacePicker::picture(const EditSurface& surface, const ViewFrame& view) {
  if (!is_current(surface, view)) {
    picture_.draw(surface.shown(), view.camera, static_cast<std::uint32_t>(view.size.x()),
                  static_cast<std::uint32_t>(view.size.y()));
    view_ = view;
    version_ = surface.version();
  }
  return {picture_.ids(), static_cast<Index>(view.size.x()), static_cast<Index>(view.size.y())};
}

ShownSurface::ShownSurface(std::shared_ptr<const Mesh> opened, FileColoring coloring)
    : opened_(std::move(opened)),
      coloring_(std::move(coloring)),
      opened_bounds_(bounds_of(surface_positions(opened_->positions, opened_->topology()))) {}

void ShownSurface::release_device() {
  device_.reset();
  release_opened();
  context_.reset();
}

void ShownSurface::use_device(std::shared_ptr<gpu::Context> context) {
  context_ = std::move(context);
  make(now_ ? *now_ : *opened_);
  measured_.reset();
  shows_numbers_ = false;
  dragged_version_.reset();
  needs_classes_ = true;
}

void ShownSurface::set_feature_angle(double degrees) {
  if (degrees == feature_angle_) return;
  feature_angle_ = degrees;
  device_.reset();
  release_opened();
  use_device(context_);
  show_still();
}

void ShownSurface::make(const Mesh& mesh) {
  device_.emplace(mesh, context_, feature_angle_);
  if (!coloring_.file) return;
  device_->surface.paint().set_file_colors(mesh, with_attributes(mesh), *coloring_.file);
}

// Surfaces with joined seams have no attributes, so these come from the meshes without.
const Mesh& ShownSurface::with_attributes(const Mesh& mesh) const {
  if (&mesh == now_.get()) return *rest_;
  return &mesh == opened_.get() ? *coloring_.opened : mesh;
}

const EditSurface& ShownSurface::opened_on_device() {
  if (!opened_device_) {
    opened_device_.emplace(context_, *opened_, feature_angle_);
    if (coloring_.file) {
      opened_device_->paint().set_file_colors(*opened_, *coloring_.opened, *coloring_.file);
    }
  }
  return *opened_device_;
}

bool ShownSurface::take(const AppState& state) {
  follows_ = false;
  followed_.clear();
  preview_ = {};
  preview_classes_.clear();
  numbers_.clear();
  std::shared_ptr<const Mesh> surface = surface_of(state);
  if (now_ == surface && settled_ == state.settled) return false;
  if (device_ && now_ != surface) device_->surface.drag_from(nullptr);
  rest_ = state.rest;
  const bool has_same_triangles = now_ && now_->shares_faces_with(*surface);
  now_ = std::move(surface);
  settled_ = state.settled;
  Positions positions = positions_of(state);
  // A result that becomes the rest shape leaves the surface where it was.
  if (has_same_triangles && positions == positions_) return false;
  positions_ = std::move(positions);
  bounds_ = bounds_of(surface_positions(positions_, now_->topology()));
  return true;
}

const Positions& ShownSurface::still_positions() const {
  return previews() ? preview_positions_ : before_ ? opened_->positions : positions_;
}

void ShownSurface::show_still() {
  put(*(previews() ? preview_ : before_ ? opened_ : now_), still_positions());
}

void ShownSurface::put(const Mesh& mesh, const Positions& positions) {
  if (device_->topology.get() != &mesh.topology()) {
    // Two at a time may not fit on the device.
    device_.reset();
    make(mesh);
    measured_.reset();
    shows_numbers_ = false;
    dragged_version_.reset();
    needs_classes_ = true;
  }
  device_->surface.place(positions);
}

void ShownSurface::follow(const Preparation& preparation,
                          std::span<const Eigen::Affine3d> motions) {
  const bool same =
      std::equal(motions.begin(), motions.end(), followed_.begin(), followed_.end(),
                 [](const auto& a, const auto& b) { return a.matrix() == b.matrix(); });
  // The preparation belongs to the state's triangles only.
  if (!has_triangles_of_state()) return;
  if (same && device_->surface.drags_by(preparation)) return;
  if (!device_->surface.drag(preparation, motions)) return;
  follows_ = true;
  followed_.assign(motions.begin(), motions.end());
  dragged_by_.assign(motions.begin(), motions.end());
}

void ShownSurface::follow_from(std::shared_ptr<const DragState> pose) {
  device_->surface.drag_from(std::move(pose));
  followed_.clear();  // to be drawn again
}

void ShownSurface::show_preview(std::shared_ptr<const Mesh> preview,
                                std::vector<VertexClass> classes) {
  preview_ = std::move(preview);
  preview_classes_ = std::move(classes);
  numbers_.clear();
  preview_positions_ = preview_->positions;
  preview_bounds_ = bounds_of(surface_positions(preview_positions_, preview_->topology()));
  needs_classes_ = true;
  show_still();
}

void ShownSurface::show_preview(const Positions& positions) {
  preview_positions_ = positions;
  preview_bounds_ = bounds_of(surface_positions(preview_positions_, preview_->topology()));
  show_still();
}

void ShownSurface::end_preview() {
  if (!previews()) return;
  preview_ = {};
  preview_classes_.clear();
  numbers_.clear();
  needs_classes_ = true;
  show_still();
}

void ShownSurface::show_before(bool before) {
  if (before_ == before) return;
  before_ = before;
  show_still();
}

void ShownSurface::set_classes(std::vector<VertexClass> classes) {
  needs_classes_ = false;
  if (!preview_classes_.empty()) {
    return device_->surface.paint().set_classes(preview_classes_);
  }
  if (!has_triangles_of_state()) {
    classes.assign(device_->topology->vertex_count(), VertexClass::outside);
  }
  device_->surface.paint().set_classes(classes);
}

bool ShownSurface::is_measured() const {
  if (measured_version_ != device_->surface.version()) return false;
  return has_numbers() ? shows_numbers_ : !shows_numbers_ && measure_ && measured_ == measure_;
}

void ShownSurface::renew_measure() {
  // Only a still surface is measured; a drag has no numbers yet.
  const bool still = !follows_ && device_->surface.source() == SurfaceSource::still;
  if (!still || is_measured()) return;
  if (!has_numbers() && (!measure_ || !is_comparable())) return;
  shows_numbers_ = has_numbers();
  const std::vector<float> numbers =
      has_numbers()
          ? numbers_
          : measure_pose(*measure_, opened_->topology(), opened_->positions, still_positions());
  device_->surface.paint().set_scalars(numbers);
  measure_range_ = range_without_outliers(numbers);
  measured_ = measure_;
  measured_version_ = device_->surface.version();
}

std::optional<SurfacePoint> ShownSurface::pick(const ViewFrame& view,
                                               const Eigen::Vector2d& pixel) {
  const bool inside = (pixel.array() >= 0.0).all() && (pixel.array() < view.size.array()).all();
  if (!inside) return {};
  const Positions& positions = positions_on_screen();
  const Ray ray = view.projection().ray_through(middle_of(pixel));
  const Topology& topology = *device_->topology;
  // A picture that is up to date tells which triangle to look at. Rounding may miss a triangle that
  // is seen from its edge.
  if (device_->picker.is_current(device_->surface, view)) {
    const auto triangle = device_->picker.triangle_at(pixel);
    if (!triangle) return {};
    if (const auto found = pick_triangle(topology, positions, *triangle, ray)) return found;
  }
  return pick_surface(topology, positions, ray);
}

// Applies the device's response and motions once per version of the surface.
const Positions& ShownSurface::positions_on_screen() {
  const auto& drag = device_->surface.drag_shown();
  if (!drag) return still_positions();
  if (dragged_version_ != device_->surface.version()) {
    dragged_positions_ = drag->response()->rest();
    Drag(drag->response(), drag->pose()).move(dragged_by_, dragged_positions_);
    dragged_version_ = device_->surface.version();
  }
  return dragged_positions_;
}

TrianglePicture ShownSurface::picture(const ViewFrame& view) {
  return device_->picker.picture(device_->surface, view);
}

Bounds ShownSurface::bounds() const {
  const Bounds all = united(opened_bounds_, bounds_);
  return previews() ? united(all, preview_bounds_) : all;
}

}  // namespace lapwing::viewer
