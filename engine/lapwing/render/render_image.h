#pragma once

#include <cstdint>
#include <span>
#include <string>

#include "lapwing/io/image.h"
#include "lapwing/render/camera.h"
#include "lapwing/render/offscreen.h"
#include "lapwing/render/renderer.h"

namespace lapwing {

struct RenderOptions {
  std::uint32_t width = 1280;  ///< in pixels
  std::uint32_t height = 960;  ///< in pixels
  std::uint32_t samples = 4;   ///< per pixel, where the device has them
  Background background = Background::gradient;
  SurfaceStyle style;
  bool legend = true;        ///< beside a surface coloured by numbers
  std::string legend_title;  ///< above the legend, in lines; may be empty

  double aspect() const { return static_cast<double>(width) / static_cast<double>(height); }
};

/// Pictures without a display, one after the other: keeps the pipelines and images that one takes.
/// Same input, same bits on one device. The context must outlive it.
class ImageRenderer {
 public:
  /// Throws GpuError for a device that cannot draw and for sizes beyond its limits.
  ImageRenderer(gpu::Context& context, const RenderOptions& options);

  /// `surface` as its buffers are now, and what is carried along with it; all on the context.
  Image render(Surface& surface, const SurfacePaint& paint, const Camera& camera,
               std::span<const CarriedDrawing> carried = {});

 private:
  gpu::Context& context_;
  RenderOptions options_;
  OffscreenTarget target_;
  Renderer renderer_;
};

/// One such picture, on the context of `surface`.
Image render_image(Surface& surface, const SurfacePaint& paint, const Camera& camera,
                   const RenderOptions& options = {}, std::span<const CarriedDrawing> carried = {});

}  // namespace lapwing
