#pragma once

#include <cstdint>
#include <optional>

#include "editing/edit_surface.h"
#include "editing/view_frame.h"
#include "lapwing/render/id_picture.h"
#include "tools/seen_vertices.h"

namespace lapwing::viewer {

/// Finds the triangle at a pixel in a picture, which it draws again only if the view or the surface
/// has changed. Both must outlive the call. The context must outlive the picker.
class SurfacePicker {
 public:
  explicit SurfacePicker(gpu::Context& context) : picture_(context) {}

  /// Returns whether the picture is up to date.
  bool is_current(const EditSurface& surface, const ViewFrame& view) const {
    return view_ == view && version_ == surface.version();
  }

  /// Returns the triangle at `pixel` of the last picture; nothing beside the surface.
  std::optional<Index> triangle_at(const Eigen::Vector2d& pixel) const;

  /// Returns the whole picture, valid until the next call. Waits for the device if it must be
  /// drawn.
  TrianglePicture picture(const EditSurface& surface, const ViewFrame& view);

 private:
  IdPicture picture_;
  std::optional<ViewFrame> view_;  // of the picture
  std::uint64_t version_ = 0;      // of the surface in it
};

}  // namespace lapwing::viewer
