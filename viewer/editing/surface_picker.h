#pragma once

#include <cstdint>
#include <optional>

#include "editing/edit_surface.h"
#include "editing/view_frame.h"
#include "lapwing/render/id_picture.h"
#include "tools/seen_vertices.h"

namespace lapwing::viewer {

/// Which triangle shows where, asked of a picture that is drawn again only when the view or the
/// surface is another one. Both must outlive the call they are handed to. The context must outlive
/// the picker.
class SurfacePicker {
 public:
  explicit SurfacePicker(gpu::Context& context) : picture_(context) {}

  /// Whether the picture is there already.
  bool is_current(const EditSurface& surface, const ViewFrame& view) const {
    return view_ == view && version_ == surface.version();
  }

  /// The triangle at `pixel` of the picture that was drawn last; nothing beside the surface.
  std::optional<Index> triangle_at(const Eigen::Vector2d& pixel) const;

  /// The whole picture; valid until the next call. Waits for the device where it is to be drawn.
  TrianglePicture picture(const EditSurface& surface, const ViewFrame& view);

 private:
  IdPicture picture_;
  std::optional<ViewFrame> view_;  // of the picture
  std::uint64_t version_ = 0;      // of the surface in it
};

}  // namespace lapwing::viewer
