#include "editing/surface_picker.h"

namespace lapwing::viewer {

void SurfacePicker::renew(const EditSurface& surface, const ViewFrame& view) {
  if (is_current(surface, view)) return;
  picture_.draw(surface.shown(), view.camera, static_cast<std::uint32_t>(view.size.x()),
                static_cast<std::uint32_t>(view.size.y()));
  view_ = view;
  version_ = surface.version();
}

std::optional<SurfacePoint> SurfacePicker::pick(const EditSurface& surface, const ViewFrame& view,
                                                const Eigen::Vector2d& pixel) {
  if (pixel.x() < 0.0 || pixel.y() < 0.0) return {};
  renew(surface, view);
  const auto pick = picture_.pick(surface.shown(), static_cast<std::uint32_t>(pixel.x()),
                                  static_cast<std::uint32_t>(pixel.y()));
  if (!pick) return {};
  return SurfacePoint{pick->triangle, pick->vertex, pick->position};
}

TrianglePicture SurfacePicker::picture(const EditSurface& surface, const ViewFrame& view) {
  renew(surface, view);
  return {picture_.ids(), static_cast<Index>(view.size.x()), static_cast<Index>(view.size.y())};
}

}  // namespace lapwing::viewer
