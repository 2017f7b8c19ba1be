#include "editing/surface_picker.h"

namespace lapwing::viewer {

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

}  // namespace lapwing::viewer
